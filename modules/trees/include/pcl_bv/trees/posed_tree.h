// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Queries of a PointTree as if its points had been moved.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "pcl_bv/trees/point_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The points of a PointTree after a rigid motion. The points are not moved. Instead, each query is moved to
/// the tree's frame.
///
/// The tree must outlive this object. A query volume is moved back and inflated, which covers the rounding of
/// the inverse matrix. So every point is found whose image (by exact arithmetic on the stored matrix) is
/// inside the volume. Points outside are found only if they are within about 1e-15 of the coordinates. Query
/// points are rounded when they are moved back, and distances are computed in the tree's frame. Query points
/// and distances are accurate to about 1e-15 of the coordinates.
class PosedTree {
 public:
  /// Places `tree` at `pose`, the transform from the tree's frame to the frame of the queries. Throws
  /// std::invalid_argument unless the pose is finite and its axes are unit vectors and orthogonal to 1e-6.
  PosedTree(const PointTree& tree, const Eigen::Isometry3d& pose);

  /// Like the PointTree member functions of the same name, with arguments in the frame of the queries.
  std::optional<Neighbor> nearest(const Eigen::Vector3d& point,
                                  double max_distance = std::numeric_limits<double>::infinity()) const;
  void nearest(const Eigen::Vector3d& point, std::size_t k, std::vector<Neighbor>& found,
               double max_distance = std::numeric_limits<double>::infinity()) const;
  void near(const Eigen::Vector3d& point, double distance, std::vector<Neighbor>& found) const;

  /// Like the PointTree member functions of the same name, with the volume in the frame of the queries.
  bool any_inside(const AnyVolume& volume) const;
  std::size_t count_inside(const AnyVolume& volume) const;
  void all_inside(const AnyVolume& volume, std::vector<std::int32_t>& indices) const;

  /// Like PointTree::first_hit(), with origin and direction in the frame of the queries.
  std::optional<PointHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                    double radius) const;

 private:
  AnyVolume moved_back(const AnyVolume& volume) const;

  const PointTree& tree_;
  Eigen::Isometry3d back_;  // inverse of the pose
  double rounding_;         // bound of |back_ (pose p) - p| for points p of the tree
};

}  // namespace pcl_bv
