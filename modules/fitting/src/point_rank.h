// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How many dimensions a cloud spans: one definition for all methods.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {

/// Thinner than this, in units of the extent rounded down to a power of two, is flat: what the rounding of
/// doubles moves points by there is a 2^-16th of it.
inline constexpr double kFlat = 0x1p-36;

/// What points span, dimension after dimension: p0 is the first of them by (x, y, z), p1 the one farthest
/// from p0, p2 from the line p0 p1, p3 from the plane p0 p1 p2; of equally far ones the first by (x, y, z).
struct Span {
  int rank = 0;  ///< Of these three distances, those before the first that is not above kFlat.

  /// Orthonormal; the first `rank` towards p1, p2 and p3, each across those before.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// The three distances, in local units, or kFlat for those that are not above it.
  Eigen::Vector3d reach = Eigen::Vector3d::Constant(kFlat);
};

/// Of a cloud with at least one valid point; `scale` is that of its LocalFrame. The same for every execution
/// and every order of the points. O(n), a pass for each distance and one for p0. Needs a FloatEnvironment.
Span span_of(const PointView& points, double scale, const Execution& execution);

/// The rank of span_of(), 0 without a valid point. `supports` of the same points. Four points that span a
/// solid decide, so for nearly all clouds the first four that are looked at do. Needs a FloatEnvironment.
/// O(n) where a cloud is as thin as 2^-30 of its extent and not across a coordinate axis.
int point_rank(const PointView& points, const Supports& supports, const Execution& execution);

}  // namespace pcl_bv
