// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is left of a ray, never too little: the slab method (Kay, Kajiya 1986) with its rounding put
// outward.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/volumes/ray_interval.h"

namespace pcl_bv::volumes_internal {

class RayClip {
 public:
  /// Keeps the t with t * slope <= bound. What is NaN clips nothing. The caller sees to it that the slope is
  /// none too great, nor the bound too small but for one rounding; the quotient's and that one interval()
  /// adds.
  void keep(double slope, double bound) {
    if (slope > 0) {
      exit_ = std::min(exit_, bound / slope);
    } else if (slope < 0) {
      enter_ = std::max(enter_, bound / slope);
    } else if (slope == 0 && bound < 0) {
      exit_ = -1;
    }
  }

  /// Keeps what lies between; one rounding of each is allowed for.
  void keep_between(double enter, double exit) {
    enter_ = std::max(enter_, enter);
    exit_ = std::min(exit_, exit);
  }

  /// Keeps what is within `radius` of a point or a line, whose distance is `least` where t 2^exponent is
  /// `nearest` and of which the ray moves `speed` away per unit of that.
  void keep_near(double nearest, double least, double radius, double speed, int exponent) {
    if (least > radius) return keep(0, -1);
    const double half = std::sqrt(radius - least) * std::sqrt(radius + least) / speed * (1 + 0x1p-49);
    keep_between(std::ldexp(nearest - half, -exponent), std::ldexp(nearest + half, -exponent));
  }

  /// Both ends moved outward by 2^-51 of themselves (two roundings and that of the move itself) and, where
  /// they underflow, the smallest normal. Nothing if none of t >= 0 is left.
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

/// A direction of any length as u 2^exponent, the greatest component of u in [1, 2): squares of u are in
/// range.
struct ScaledDirection {
  explicit ScaledDirection(const Eigen::Vector3d& direction)
      : exponent(std::ilogb(direction.cwiseAbs().maxCoeff())),
        u(direction.unaryExpr([this](double x) { return std::ldexp(x, -exponent); })) {}
  int exponent;
  Eigen::Vector3d u;
};

/// A volume's intersect(): `clip(ray)` cuts a proper ray; this is the answer where there is none. A zero
/// direction is a point test.
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

}  // namespace pcl_bv::volumes_internal
