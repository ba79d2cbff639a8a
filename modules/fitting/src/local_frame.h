// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The coordinates in which spheres are computed: near zero and about 1, whatever the cloud's are.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/numeric/directed.h"

namespace pcl_bv {

/// Half of the 2^-48 that the numeric rules allow a squared distance to be off by: it covers the root, too.
inline constexpr double kOutward = 1.0 + 0x1p-49;

inline Eigen::Vector3d vector(const Coordinates& p) {
  return {p.x, p.y, p.z};
}

/// The greatest width along an axis, in the unit of the points; 0 if all are equal.
double widest_side(const Supports& supports);

/// The power of two that brings a positive extent into [1, 2), as far as doubles have it (for 2^-1000 and
/// below it is 2^1000); 1 for 0.
double unit_scale(double extent);

/// Relative to one of the cloud's points, in units of a power of two near its extent.
class LocalFrame {
 public:
  /// Of a cloud with at least one valid point.
  explicit LocalFrame(const Supports& supports);

  /// As widest_side() says.
  double extent() const { return extent_; }

  Eigen::Vector3d local(const Coordinates& p) const { return (vector(p) - origin_) * scale_; }
  Eigen::Vector3d global(const Eigen::Vector3d& local) const { return origin_ + local / scale_; }

  /// Where a point is, seen from a place in the coordinates of the points, in local units: each coordinate is
  /// rounded once, which changes it by at most 2^-53 of itself.
  Eigen::Vector3d seen_from(const Eigen::Vector3d& center, const Coordinates& p) const {
    return (vector(p) - center) * scale_;
  }

  /// A local length in the unit of the points, not greater, and not smaller.
  double length_down(double local) const { return divide_down(local, scale_); }
  double length_up(double local) const { return divide_up(local, scale_); }

  /// Local units per unit of the points: a power of two.
  double scale() const { return scale_; }

  /// For the kernels, and the measures that they give: in the unit of the points for float clouds.
  DistanceCenter center(const Eigen::Vector3d& global) const {
    return {global.x(), global.y(), global.z(), kernel_scale_};
  }

  /// A kernel's distance as a radius in the unit of the points, not smaller.
  double radius(double distance) const { return divide_up(distance, kernel_scale_); }

 private:
  Eigen::Vector3d origin_;
  double extent_;
  double scale_;
  double kernel_scale_;
};

}  // namespace pcl_bv
