// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How the sensor moved, from what stood still.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "box_grid.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A turn about z and a shift in the plane: p becomes turn(yaw) p + shift.
struct PlanarMotion {
  double yaw = 0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {c * p.x() - s * p.y() + shift.x(), s * p.x() + c * p.y() + shift.y()};
  }
  PlanarMotion operator*(const PlanarMotion& first) const { return {yaw + first.yaw, *this * first.shift}; }
  PlanarMotion inverse() const {
    const PlanarMotion turn{-yaw};
    return {-yaw, -(turn * shift)};
  }
};

/// Finds the motion that takes most of the expected boxes to boxes that were seen. Reuse keeps the capacity.
class EgoMotion {
 public:
  /// `expected` and `seen` in the sensor's frame. The result takes expected boxes to seen ones: first the
  /// nearest from `guess` (trimmed least squares in ever smaller radii); where most find no partner, from
  /// the shift that most pairs vote for, for a few turns. False, and the motion stays what it was, unless at
  /// least six pairs and three tenths of the boxes that could have a partner agree to 0.35 m.
  bool estimate(const std::vector<Aabb>& expected, const std::vector<Aabb>& seen, const PlanarMotion& guess,
                PlanarMotion& motion);

 private:
  struct Pair {
    Eigen::Vector2d from, to;
  };

  void match(const std::vector<Aabb>& expected, const std::vector<Aabb>& seen, const PlanarMotion& motion,
             double radius);
  std::size_t refine(const std::vector<Aabb>& expected, const std::vector<Aabb>& seen, PlanarMotion& motion,
                     double radius);
  void vote(const std::vector<Aabb>& expected, const std::vector<Aabb>& seen, PlanarMotion& motion);

  BoxGrid grid_;
  std::vector<Pair> pairs_;
  std::vector<unsigned> votes_;
};

}  // namespace pcl_bv
