// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "pcl_bv/trees/point_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A tree's points as they are after a rigid motion, at no cost: questions are moved back to the tree, which
/// must outlive this. A volume comes back as one that holds all of it (transformed(), grown by the rounding
/// of the inverse matrix), so no point is missed whose image, by exact arithmetic on the stored matrix, is
/// inside; it errs only towards true, by some 1e-15 of the coordinates. Places come back rounded, and
/// distances are those in the tree's frame: as far from the exact ones.
class PosedTree {
 public:
  /// `pose` leads from the tree's frame to that of the questions. Throws std::invalid_argument unless it is
  /// finite and its axes are unit and orthogonal to 1e-6.
  PosedTree(const PointTree& tree, const Eigen::Isometry3d& pose);

  std::optional<Neighbor> nearest(const Eigen::Vector3d& place,
                                  double max_distance = std::numeric_limits<double>::infinity()) const;
  void nearest(const Eigen::Vector3d& place, std::size_t k, std::vector<Neighbor>& found,
               double max_distance = std::numeric_limits<double>::infinity()) const;
  void near(const Eigen::Vector3d& place, double distance, std::vector<Neighbor>& found) const;

  bool any_inside(const AnyVolume& volume) const;
  std::size_t count_inside(const AnyVolume& volume) const;
  void all_inside(const AnyVolume& volume, std::vector<std::int32_t>& indices) const;

  std::optional<PointHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                    double radius) const;

 private:
  AnyVolume moved_back(const AnyVolume& volume) const;

  const PointTree& tree_;
  Eigen::Isometry3d back_;
  double rounding_;  // how far a point of the tree may be from its image, moved back
};

}  // namespace pcl_bv
