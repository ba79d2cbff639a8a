// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The outline of a convex hull seen along any direction.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hull/convex_hull.h"

namespace pcl_bv::detail {

/// Computes the silhouettes of a solid hull under parallel projection. For the hull of a car, which has about
/// 28 vertices, a silhouette has about 12 corners.
class Silhouette {
 public:
  struct Step {
    std::int32_t from, to;  ///< Indices of the vertices at the ends of an edge.
  };

  /// Result of project(), with its working memory.
  struct Projection {
    std::vector<double> facing;            ///< One value per facet; positive if the facet faces the viewer.
    std::vector<Step> rim;                 ///< Edges of the silhouette, in the order of edges().
    std::vector<std::int32_t> next;        ///< For each vertex of the silhouette, the next one along it.
    std::vector<Eigen::Vector2d> corners;  ///< Corners of the silhouette, which project() returns.
  };

  /// The vertices and triangles must be those of a LocalHull of rank 3, in local coordinates.
  Silhouette(std::vector<Eigen::Vector3d> vertices, const std::vector<Triangle>& triangles);

  struct Edge {
    std::int32_t from, to;
    std::int32_t left, right;  ///< Facets to the left and right of from -> to, seen from outside.
  };

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const std::vector<Edge>& edges() const { return edges_; }
  std::size_t facets() const { return normals_[0].size(); }

  /// Returns the outward normal of a facet; its length is twice the facet's area.
  Eigen::Vector3d normal(std::size_t facet) const {
    return {normals_[0][facet], normals_[1][facet], normals_[2][facet]};
  }

  /// Returns projection.corners, the corners of the silhouette along u x v, counter-clockwise, in the
  /// coordinates (u, v). The polygon is convex up to rounding. The edges of the silhouette are those edges of
  /// the hull that are between a facet that faces the viewer and a facet that does not. Therefore no corners
  /// need to be sorted. O(vertices).
  const std::vector<Eigen::Vector2d>& project(const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                                              Projection& projection) const;

 private:
  void find_rim(const Eigen::Vector3d& towards, Projection& projection) const;
  bool follow_rim(const Eigen::Vector3d& u, const Eigen::Vector3d& v, Projection& projection) const;

  std::vector<Eigen::Vector3d> vertices_;
  std::array<std::vector<double>, 3> normals_;  // x, y and z of the facets' normals
  std::vector<Edge> edges_;
};

}  // namespace pcl_bv::detail
