// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Estimates the planar motion of the sensor from static boxes.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "box_grid.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A rotation about z and a shift in the plane, which map p to rotation(yaw) p + shift. Radians and metres.
struct PlanarMotion {
  double yaw = 0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    const double c = std::cos(yaw), s = std::sin(yaw);
    return {c * p.x() - s * p.y() + shift.x(), s * p.x() + c * p.y() + shift.y()};
  }
  PlanarMotion operator*(const PlanarMotion& first) const { return {yaw + first.yaw, *this * first.shift}; }
  PlanarMotion inverse() const {
    const PlanarMotion rotation{-yaw};
    return {-yaw, -(rotation * shift)};
  }
};

/// Finds the motion that maps most of the expected boxes to measured boxes. A reused object keeps its
/// capacity.
class EgoMotion {
 public:
  /// Finds the motion that maps the `expected` boxes to the measured boxes `seen`. All boxes are in the
  /// sensor's frame.
  ///
  /// Starts from `guess`. Alternately pairs each expected box with the nearest measured box of similar size,
  /// within ever smaller radii, and fits the motion to the pairs by least squares. Only expected boxes
  /// shorter than 6 m are used and counted. If fewer than 40 % of them get a pair, the search is repeated for
  /// each of five yaw angles. Each repetition starts from the most frequent shift from an expected to a
  /// measured box.
  ///
  /// Returns true and sets `motion` if the found motion brings at least six expected boxes, and at least 30 %
  /// of them, to within 0.35 m of a measured box. Otherwise returns false.
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

}  // namespace detail
}  // namespace pcl_bv
