// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Conservative clipping of a ray by the slab method (Kay, Kajiya 1986) with rounding outward.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/power_of_two.h"
#include "pcl_bv/volumes/geometry.h"

namespace pcl_bv::detail {

class RayClip {
 public:
  /// Restricts the interval to the t with t * slope <= bound. If an argument is NaN, the interval does not
  /// change. A rounded `slope` must be rounded down. A rounded `bound` may be too small by one rounding, but
  /// not by more. interval() allows for this rounding and for that of bound / slope.
  void keep(double slope, double bound) {
    if (slope > 0) {
      exit_ = std::min(exit_, bound / slope);
    } else if (slope < 0) {
      enter_ = std::max(enter_, bound / slope);
    } else if (slope == 0 && bound < 0) {
      exit_ = -1;
    }
  }

  /// Restricts the interval to the t from `enter` to `exit`. interval() allows for one rounding of each
  /// argument.
  void keep_between(double enter, double exit) {
    enter_ = std::max(enter_, enter);
    exit_ = std::min(exit_, exit);
  }

  /// Restricts the interval to the t where the ray is within `radius` of a point or a line. With s = t
  /// 2^exponent, the squared distance of the ray from this point or line is min_distance^2 + (speed (s -
  /// nearest))^2.
  void keep_within_radius(double nearest, double min_distance, double radius, double speed, int exponent) {
    if (min_distance > radius) return keep(0, -1);
    const double half =
        std::sqrt(radius - min_distance) * std::sqrt(radius + min_distance) / speed * (1 + 0x1p-49);
    keep_between(times_power_of_two(nearest - half, -exponent),
                 times_power_of_two(nearest + half, -exponent));
  }

  /// Returns the remaining interval, or nothing if it contains no t >= 0. Both ends are moved outward by
  /// 2^-51 of their magnitude plus the smallest normal number. The first term covers two roundings and the
  /// rounding of the move. The second term covers underflow.
  std::optional<RayInterval> interval() const {
    using Limits = std::numeric_limits<double>;
    const double finite_enter = std::min(enter_, Limits::max());
    const double enter = std::max(0.0, finite_enter - (0x1p-51 * finite_enter + Limits::min()));
    const double exit = exit_ + (0x1p-51 * std::abs(exit_) + Limits::min());
    if (!(enter <= exit)) return std::nullopt;
    return RayInterval{enter, exit};
  }

 private:
  double enter_ = 0;
  double exit_ = kInfinity;
};

/// A direction of any length, stored as u * 2^exponent. The largest component of u has a magnitude in [1, 2),
/// so that |u|^2 is in the range of double.
struct ScaledDirection {
  explicit ScaledDirection(const Eigen::Vector3d& direction)
      : exponent(binary_exponent(
            std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])}))),
        u(times_power_of_two(direction[0], -exponent), times_power_of_two(direction[1], -exponent),
          times_power_of_two(direction[2], -exponent)) {}
  int exponent;
  Eigen::Vector3d u;
};

/// Implements Volume::intersect(). `clip(ray)` clips a ray whose direction is not zero. If the direction is
/// zero, the function tests whether the volume contains the origin. Returns nothing for an empty volume and
/// for numbers that are not finite.
template <typename Volume, typename Clip>
std::optional<RayInterval> intersect_ray(const Volume& volume, const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction, const Clip& clip) {
  const FloatEnvironment environment;
  if (volume.empty() || !origin.allFinite() || !direction.allFinite()) return std::nullopt;
  RayClip ray;
  if (!direction.isZero(0)) {
    clip(ray);
  } else if (!volume.contains(origin)) {
    return std::nullopt;
  }
  return ray.interval();
}

}  // namespace pcl_bv::detail
