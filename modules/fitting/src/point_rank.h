// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The rank of a cloud, which is the number of dimensions that it spans. All methods use this definition.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// Limit of the thickness below which points are flat. The unit is the extent rounded down to a power of two.
/// In this unit the rounding of doubles moves points by about 2^-52, which is 2^-16 of the limit.
inline constexpr double kFlat = 0x1p-36;

/// The dimensions that points span. p0 is the first point in lexicographic order of (x, y, z). p1 is the
/// point farthest from p0, p2 the point farthest from the line p0 p1, and p3 the point farthest from the
/// plane p0 p1 p2. Of equally far points the first in lexicographic order is taken.
struct Span {
  int rank = 0;  ///< Number of these three distances before the first that is not above kFlat.

  /// Orthonormal axes. The first `rank` columns point towards p1, p2 and p3, each perpendicular to the
  /// columns before it.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// The three distances in local units. A distance that is not above kFlat is replaced by kFlat.
  Eigen::Vector3d distances = Eigen::Vector3d::Constant(kFlat);
};

/// Computes the span of a cloud with at least one valid point. `scale` is LocalFrame::scale() of the cloud.
/// The result is the same for every execution and every order of the points. O(n), in one pass for p0 and one
/// pass for each distance. Needs a FloatEnvironment.
Span span_of(const PointView& points, double scale, const FitExecution& execution);

/// Returns the rank that span_of() defines, or 0 without a valid point. `supports` must be of the same
/// points. If four points clearly span a solid, the rank is 3. For nearly all clouds, the first four points
/// inspected do. O(n) if a cloud is flat to 2^-30 of its extent, unless its plane is perpendicular to a
/// coordinate axis. Needs a FloatEnvironment.
int point_rank(const PointView& points, const Supports& supports, const FitExecution& execution);

}  // namespace pcl_bv::detail
