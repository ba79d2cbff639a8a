// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex outline of a cloud seen from above.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "local_frame.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "small_vector.h"

namespace pcl_bv::detail {

/// The plane perpendicular to `up`, with the orthonormal axes `east` and `north`.
struct Ground {
  explicit Ground(const Eigen::Vector3d& unit_up);

  /// Returns the coordinates of a point seen from above.
  Eigen::Vector2d flat(const Eigen::Vector3d& p) const { return {east.dot(p), north.dot(p)}; }

  /// Returns orthonormal axes: the first is up, the second is along `side`.
  Eigen::Matrix3d axes_along(const Eigen::Vector2d& side) const;

  Eigen::Vector3d up, east, north;
};

/// Corners of a convex polygon, counter-clockwise. Up to 1024 corners are stored without an allocation. For a
/// small cluster, of which a sweep can have thousands, an allocation would take longer than computing the
/// outline.
using Outline = SmallVector<Eigen::Vector2d, 1024>;

/// Returns the convex outline of the points seen from above, in local coordinates. The outline has at least
/// one corner, and rounding errors. `supports` must have the set dop26 and SupportDetail::points. The bits
/// are the same for every execution.
Outline outline_from_above(const PointView& points, const Supports& supports, const LocalFrame& frame,
                           const Ground& ground, const FitExecution& execution);

}  // namespace pcl_bv::detail
