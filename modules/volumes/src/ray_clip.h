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

/// A volume's intersect(): `clip(ray)` cuts a proper ray; this is the answer where there is none. A zero
/// direction is a point test.
template <typename Volume, typename Clip>
std::optional<RayInterval> intersect_ray(const Volume& volume, const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction, const Clip& clip) {
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
