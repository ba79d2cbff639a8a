// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The rank of a cloud, which is the number of dimensions that it spans. All methods use this definition.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// Points are flat if their thickness is at most this limit. The unit is the extent rounded down to a power
/// of two. In this unit the rounding of doubles moves points by about 2^-52, which is 2^-16 of the limit.
inline constexpr double kFlat = 0x1p-36;

/// The dimensions that points span. p0 is the first point in lexicographic order of (x, y, z). p1 is the
/// point farthest from p0, p2 the point farthest from the line p0 p1, and p3 the point farthest from the
/// plane p0 p1 p2. Of equally far points the first in lexicographic order is taken. d1, d2 and d3 are these
/// three distances in local units.
struct Span {
  int rank = 0;  ///< 0 if d1 <= kFlat, otherwise 1 if d2 <= kFlat, otherwise 2 if d3 <= kFlat, otherwise 3.

  /// Orthonormal axes. The first `rank` columns point towards p1, p2 and p3, each perpendicular to the
  /// columns before it.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// The first `rank` of the distances d1, d2, d3. The other elements are kFlat.
  Eigen::Vector3d distances = Eigen::Vector3d::Constant(kFlat);
};

/// Computes the span of a cloud with at least one valid point. `scale` is LocalFrame::scale() of the cloud.
/// The result is the same for every execution and every order of the points. O(n), in one pass for p0 and one
/// pass for each distance. Needs a FloatEnvironment.
Span span_of(const PointView& points, double scale, const FitExecution& execution);

/// Returns the rank that span_of() defines, or 0 without a valid point. `supports` must be of the same
/// points. For nearly all clouds, inspects only a few points: if four points clearly span a solid, the rank
/// is 3. If sides of the points' box are exactly 0, it is enough that a few points clearly span the
/// dimensions of the other sides. Other clouds that are flat to 2^-30 of their extent take O(n). Needs a
/// FloatEnvironment.
int point_rank(const PointView& points, const Supports& supports, const FitExecution& execution);

}  // namespace pcl_bv::detail
