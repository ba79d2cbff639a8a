// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hull/convex_hull.h"

namespace pcl_bv {

/// The rim of a solid hull, as it is seen from far away: of 28 vertices, what a car's hull has, some 12.
class Silhouette {
 public:
  struct Step {
    std::int32_t from, to;  ///< Vertices.
  };

  /// The room for what is seen.
  struct View {
    std::vector<double> facing;      ///< Facets: more than 0 if seen.
    std::vector<Step> rim;           ///< In the order of the edges.
    std::vector<std::int32_t> next;  ///< The vertex after a vertex of the rim.
    std::vector<Eigen::Vector2d> corners;
  };

  /// As a LocalHull of rank 3 has them.
  Silhouette(std::vector<Eigen::Vector3d> vertices, const std::vector<Triangle>& triangles);

  struct Edge {
    std::int32_t from, to;
    std::int32_t left, right;  ///< Facets, seen from outside.
  };

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<Edge>& edges() const { return edges_; }
  std::size_t facets() const { return normals_[0].size(); }

  /// Outward, twice as long as the facet's area.
  Eigen::Vector3d normal(std::size_t facet) const {
    return {normals_[0][facet], normals_[1][facet], normals_[2][facet]};
  }

  /// Its corners seen along u x v as (u, v), counter-clockwise, in view.corners: a polygon that is convex up
  /// to rounding. The edges between a facet that is seen and one that is not make it, so that there is
  /// nothing to sort: O(vertices).
  const std::vector<Eigen::Vector2d>& look(const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                                           View& view) const;

 private:
  void find_rim(const Eigen::Vector3d& towards, View& view) const;
  bool follow_rim(const Eigen::Vector3d& u, const Eigen::Vector3d& v, View& view) const;

  std::vector<Eigen::Vector3d> vertices_;
  std::array<std::vector<double>, 3> normals_;  // coordinates of the facets'
  std::vector<Edge> edges_;
};

}  // namespace pcl_bv
