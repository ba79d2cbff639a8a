// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/fit_into.h"

#include <algorithm>
#include <optional>

#include "box/obb_axes.h"
#include "box/outline.h"
#include "box/symmetric_eigen.h"
#include "pcl_bv/kernels/slab_extents.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/coordinate_axis.h"
#include "pcl_bv/numeric/exact_sum.h"
#include "pcl_bv/numeric/vector3.h"
#include "same_points.h"
#include "summary.h"
#include "support/support_search.h"

namespace pcl_bv::detail {
namespace {

EstimationResult fit_dito14(const PointView& points, Obb& box, const FitExecution& execution) {
  const Supports supports = find_supports(points, DirectionSet::dop14, SupportDetail::points, execution);
  if (supports.used > 0) {
    const LocalFrame frame(supports);
    const Eigen::Matrix3d axes = dito_axes(support_or_all_points(points, supports, frame), supports, frame);
    const Aabb upright = aabb_of(supports);
    if (!axes.isIdentity(0)) box = measured_box(axes, points, supports, execution).canonical();
    if (box.empty() || !(box.surface_area() < upright.surface_area())) box = Obb(upright).canonical();
  }
  return result_of(supports);
}

EstimationResult fit_minimal(const PointView& points, Obb& box, const FitExecution& execution) {
  const Summary summary = summarize(points, execution);
  if (summary.supports.used > 0) {
    const LocalFrame frame(summary.supports);
    const Eigen::Matrix3d axes = minimal_axes(points, summary, frame, execution);
    box = measured_box(axes, points, summary.supports, execution).canonical();
  }
  return summary.result();
}

EstimationResult fit_upright(const PointView& points, const ObbOptions& options, Obb& box,
                             const FitExecution& execution) {
  const Eigen::Vector3d up = unit_up("fit_obb", options.up);
  if (options.method == ObbMethod::lshape) require_all_points(execution, "obb-lshape");
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, execution);
  if (supports.used > 0) {
    const LocalFrame frame(supports);
    const auto axes = options.method == ObbMethod::yaw ? yaw_axes : lshape_axes;
    box = measured_box(axes(points, supports, frame, up, execution), points, supports, execution).upright(up);
  }
  return result_of(supports);
}

Direction direction(const Eigen::Vector3d& axis) {
  return {axis.x(), axis.y(), axis.z()};
}

std::optional<Coordinates> first_valid(const PointView& points) {
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (is_valid(p)) return p;
  }
  return std::nullopt;
}

// Same as Obb::from_slabs(), but adds an error bound to the half extents instead of summing exactly. Exact
// sums take a seventh of the time of a box of 300 points. The offset q of the centre from the origin is a
// rounded difference, so axis . q has an error of at most 4.01 2^-53 |q|_1 (volumes/src/obb.cpp). The rounded
// difference and sum of the half extent h add 2^-52 h. The bound is at least twice that.
Obb box_between(const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin, const Eigen::Vector3d& low,
                const Eigen::Vector3d& high) {
  const auto projections = [&](const Eigen::Vector3d& q) {
    return Eigen::Vector3d(dot3(axes.col(0), q), dot3(axes.col(1), q), dot3(axes.col(2), q));
  };
  const auto from_axes = [&](const Eigen::Vector3d& s) -> Eigen::Vector3d {
    return (axes.col(0) * s[0] + axes.col(1) * s[1]) + axes.col(2) * s[2];
  };
  const Eigen::Vector3d middle = low + 0.5 * (high - low), rough = from_axes(middle);
  // The second round corrects for axes that are not exactly orthogonal.
  const Eigen::Vector3d center = origin + (rough + from_axes(middle - projections(rough)));
  const Eigen::Vector3d q = center - origin, projection = projections(q);
  Eigen::Vector3d half_extents;
  for (int i = 0; i < 3; ++i) {
    const double half = std::max(high[i] - projection[i], projection[i] - low[i]);
    half_extents[i] = half + (0x1p-50 * (taxicab3(q) + half) + kSmallestNormal);
  }
  return {center, axes, half_extents};
}

std::array<Direction, 3> columns_of(const Eigen::Matrix3d& axes) {
  return {direction(axes.col(0)), direction(axes.col(1)), direction(axes.col(2))};
}

// Returns the box of points with the extents `found`, which are relative to the first valid point. For an
// axis n and a point q relative to the first point, the margin for the rounding of n . q is 8 2^-53 of |q|_1.
// This is twice the possible error (volumes/src/obb.cpp). |q|_1 is at most the sum of the sides of the
// points' box. The smallest normal number covers products that underflow. Axes that are coordinate axes need
// no margin, because the supports along them are exact.
Obb box_of_extents(const Eigen::Matrix3d& axes, const Coordinates& origin, const Supports& supports,
                   const SlabExtents& found) {
  const Eigen::Vector3d from = vector(origin);
  const auto side = [&](std::size_t axis) { return supports.along[axis].high - supports.along[axis].low; };
  const double rounding = 0x1p-50 * ((side(0) + side(1)) + side(2)) + kSmallestNormal;
  Eigen::Vector3d low, high;
  bool has_coordinate_axis = false;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = found.low[i] - rounding;
    high[i] = found.high[i] + rounding;
    const std::optional<int> k = coordinate_axis(axes.col(i));
    if (!k || axes(*k, i) < 0) continue;
    has_coordinate_axis = true;
    low[i] = round_down(exact_sum(supports.along[*k].low, -from[*k], 0));
    high[i] = round_up(exact_sum(supports.along[*k].high, -from[*k], 0));
  }
  return has_coordinate_axis ? Obb::from_slabs(axes, from, low, high) : box_between(axes, from, low, high);
}

// Measures the box of few points. Projects all points in double arithmetic, which for 300 points takes a
// third of the time of measure_many().
Obb measure_few(const Eigen::Matrix3d& axes, const PointView& points, const Supports& supports,
                UsableIsa isa) {
  const LoadedPoints loaded(points, 0, points.count);
  const std::optional<Coordinates> origin = first_valid(loaded.view());
  require_same_points(origin && within(supports, *origin));
  return box_of_extents(axes, *origin, supports, slab_extents(isa, loaded.view(), *origin, columns_of(axes)));
}

// Measures the box of many points. The support search rejects nearly all points in float arithmetic, and its
// supports are exact.
Obb measure_many(const Eigen::Matrix3d& axes, const PointView& points, const Supports& supports,
                 const FitExecution& execution) {
  SupportDirections directions;
  for (const Direction& axis : columns_of(axes))
    directions.add(axis);
  SupportSearch search(execution.isa, directions, points.count);
  search.run(points, execution);
  require_same_points(supports.moments || search.dropped() == supports.dropped);
  Eigen::Vector3d low, high;
  for (int i = 0; i < 3; ++i) {
    const Support along = search.along(static_cast<std::size_t>(i));
    low[i] = along.low;
    high[i] = along.high;
  }
  return Obb::from_slabs(axes, low, high);
}

// Fits the box to at most kBlockPoints points in memory. Copies them once: the moments and the extents read
// this copy.
EstimationResult fit_pca_of_block(const PointView& points, Obb& box, const FitExecution& execution) {
  std::optional<Supports> own;
  const Supports& supports = find_box(points, execution, own);
  if (supports.used > 0) {
    BlockOffsets offsets;
    const Moments moments = block_moments(execution.isa, points, offsets);
    require_same_points(moments.count == supports.used && within(supports, moments.origin));
    const Eigen::Matrix3d axes = principal_axes(centroid_and_covariance(moments, supports));
    const SlabExtents found = slab_extents(execution.isa, offsets, columns_of(axes));
    box = box_of_extents(axes, moments.origin, supports, found).canonical();
  }
  return result_of(supports);
}

EstimationResult fit_pca(const PointView& points, Obb& box, const FitExecution& execution) {
  if (points.source == nullptr && points.count <= kBlockPoints && !represents_cloud(execution))
    return fit_pca_of_block(points, box, execution);
  const Summary summary = summarize_bounds(points, execution);
  if (summary.supports.used > 0)
    box = measured_box(principal_axes(summary), points, summary.supports, execution).canonical();
  return summary.result();
}

}  // namespace

Obb measured_box(const Eigen::Matrix3d& axes, const PointView& points, const Supports& supports,
                 const FitExecution& execution) {
  constexpr std::size_t few_points = 2048;
  return supports.used + supports.dropped <= few_points ? measure_few(axes, points, supports, execution.isa)
                                                        : measure_many(axes, points, supports, execution);
}

Eigen::Matrix3d principal_axes(const CentroidAndCovariance& points) {
  return symmetric_eigen(points.covariance).vectors;
}

EstimationResult fit_obb(const PointView& points, const ObbOptions& options, Obb& box,
                         const FitExecution& execution) {
  box = Obb();
  switch (options.method) {
    case ObbMethod::pca:
      return fit_pca(points, box, execution);
    case ObbMethod::dito14:
      return fit_dito14(points, box, execution);
    case ObbMethod::minimal:
      return fit_minimal(points, box, execution);
    case ObbMethod::yaw:
    case ObbMethod::lshape:
      break;
  }
  return fit_upright(points, options, box, execution);
}

}  // namespace pcl_bv::detail
