// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "local_frame.h"
#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/supports.h"
#include "small_vector.h"

namespace pcl_bv {

/// The plane seen from above, with axes of its own: along x and y if up is z.
struct Ground {
  explicit Ground(const Eigen::Vector3d& unit_up);

  Eigen::Vector2d flat(const Eigen::Vector3d& p) const { return {east.dot(p), north.dot(p)}; }

  /// Axes of which the first is up and the second along `side`.
  Eigen::Matrix3d axes_along(const Eigen::Vector2d& side) const;

  Eigen::Vector3d up, east, north;
};

/// Corners of a convex polygon, counter-clockwise; on the stack for clusters as a sweep has them by the
/// hundred.
using Outline = SmallVector<Eigen::Vector2d, 1024>;

/// The convex outline from above, in local coordinates, up to rounding; a corner at least. `supports` along
/// dop26, with points. The same bits for every execution.
Outline outline_from_above(const PointView& points, const Supports& supports, const LocalFrame& frame,
                           const Ground& ground, const Execution& execution);

}  // namespace pcl_bv
