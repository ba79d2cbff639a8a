// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Moves the points of a sweep to where the sensor would have measured them at one time.
#pragma once

#include <array>
#include <cstddef>

#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Velocity of the sensor along and about its own axes, constant during a sweep.
struct SensorMotion {
  std::array<double, 3> velocity{};          ///< m/s
  std::array<double, 3> angular_velocity{};  ///< rad/s, right-handed
};

/// Largest rotation between a point's time and time 0, radians. Up to this angle, the series of deskew() are
/// exact to 1e-8 of the distance.
inline constexpr double kMaxDeskewAngle = 0.5;

/// Writes for each point p, measured at the time t, the position that the sensor would have measured at time
/// 0: exp(t * motion) p, the screw motion that begins with the velocity v + w x p (Murray et al. 1994). `t`
/// is in `seconds`, one number for each point. `xyz` gets x, y and z of all points without gaps, in the
/// scalar type of the points. Points at (0, 0, 0) have no return and stay there. A point that is not valid,
/// or would not be valid afterwards, stays as it is.
///
/// The bits are the same for every `isa`: each operation is rounded to the scalar type. The rotation must be
/// at most kMaxDeskewAngle for every t. The caller must hold a FloatEnvironment. O(points). Throws
/// std::invalid_argument if the points are not in memory.
void deskew(UsableIsa isa, const PointView& points, const float* seconds, const SensorMotion& motion,
            std::byte* xyz);

}  // namespace detail
}  // namespace pcl_bv
