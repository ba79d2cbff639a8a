// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The exact maximum projection of a set of points along any direction. Most points are not inspected.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "hull/local_hull.h"

namespace pcl_bv::detail {

/// A tree of oriented boxes over points. Each box is oriented along its points, because on a smooth surface
/// axis-aligned boxes would be so loose that a query inspects hundreds of points, not tens.
class SupportTree {
 public:
  /// Stores a reference to the points. `queries` is the expected number of queries. For few queries, the tree
  /// has only one node, because a deeper tree would take more time than it saves. O(m log m) for m points.
  SupportTree(const std::vector<HullPoint>& points, std::size_t queries);

  /// Returns the exact maximum of normal . p over the points as stored, rounded up to a double. Components of
  /// the normal must be at most 2 in magnitude. O(log m) if few points have nearly the maximum projection.
  double max_projection_up(const Eigen::Vector3d& normal) const;

 private:
  struct Node {
    Eigen::Matrix3d axes;
    Eigen::Vector3d center, half;  // centre and half extents of the box, in local coordinates
    std::uint32_t begin, end;      // range of the node's points in order_
    // Position of the second child in nodes_, or 0 for a leaf. The first child follows its parent.
    std::uint32_t second;

    // Returns an upper bound of the projections of the node's points.
    double projection_bound(const Eigen::Vector3d& normal) const;
  };

  Eigen::Matrix3d sides(std::uint32_t begin, std::uint32_t end) const;
  Node box(std::uint32_t begin, std::uint32_t end) const;

  void build(std::uint32_t begin, std::uint32_t end, std::size_t leaf_points);
  double greatest(const Eigen::Vector3d& normal, double known, std::uint32_t node) const;
  void max_projection_up(const Eigen::Vector3d& normal, double least, std::uint32_t node,
                         double& projection) const;
  const HullPoint& point(std::uint32_t i) const { return points_[order_[i]]; }

  const std::vector<HullPoint>& points_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace pcl_bv::detail
