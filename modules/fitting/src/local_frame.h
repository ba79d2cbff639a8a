// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Local coordinates for numerical work. They are relative to a point of the cloud, and scaled such that the
// extent of the cloud is about 1.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/numeric/directed.h"

namespace pcl_bv::detail {

/// Factor that makes the square root of a squared_distance() an upper bound of the distance. The relative
/// error of the root is less than 4 2^-53. The margin 2^-49 is four times this error (docs/numerics.md,
/// Spheres).
inline constexpr double kOutward = 1.0 + 0x1p-49;

inline Eigen::Vector3d vector(const Coordinates& p) {
  return {p.x, p.y, p.z};
}

/// Returns the largest extent along a coordinate axis, in the unit of the points; 0 if all points are equal.
double widest_side(const Supports& supports);

/// Returns the power of two that scales a positive extent into [1, 2), limited to 2^-1000 .. 2^1000. For
/// extent 0, returns 1.
double unit_scale(double extent);

/// Converts to and from local coordinates. Local coordinates are relative to one of the cloud's points, and
/// their unit is a power of two near the cloud's extent.
class LocalFrame {
 public:
  /// `supports` must have SupportDetail::points. The cloud must have at least one valid point.
  explicit LocalFrame(const Supports& supports);

  /// The widest_side() of the cloud.
  double extent() const { return extent_; }

  Eigen::Vector3d local(const Coordinates& p) const { return (vector(p) - origin_) * scale_; }
  Eigen::Vector3d global(const Eigen::Vector3d& local) const { return origin_ + local / scale_; }

  /// Returns p - center in local units. The arguments are in the coordinates of the points. Each coordinate
  /// of the result is rounded once, by at most 2^-53 of itself.
  Eigen::Vector3d relative_to(const Eigen::Vector3d& center, const Coordinates& p) const {
    return (vector(p) - center) * scale_;
  }

  /// Converts a local length to the unit of the points, rounded down and rounded up.
  double length_down(double local) const { return divide_down(local, scale_); }
  double length_up(double local) const { return divide_up(local, scale_); }

  /// Returns the number of local units per unit of the points, a power of two.
  double scale() const { return scale_; }

  /// Returns a centre for the distance kernels. For float clouds, the kernels with this centre measure in the
  /// unit of the points. For double clouds, they measure in local units.
  DistanceCenter center(const Eigen::Vector3d& global) const {
    return {global.x(), global.y(), global.z(), kernel_scale_};
  }

  /// Converts a distance of the kernels to a radius in the unit of the points, rounded up.
  double radius(double distance) const { return divide_up(distance, kernel_scale_); }

 private:
  Eigen::Vector3d origin_;
  double extent_;
  double scale_;
  double kernel_scale_;
};

}  // namespace pcl_bv::detail
