// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Choose axes, measure.

#include "pcl_bv/fitting/fit_obb.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "farthest_points.h"
#include "obb_axes.h"
#include "pcl_bv/kernels/exact_dot.h"
#include "pcl_bv/kernels/float_environment.h"

namespace pcl_bv {
namespace {

Eigen::Vector3d unit_up(const Eigen::Vector3d& up) {
  const double largest = up.cwiseAbs().maxCoeff();
  if (!up.allFinite() || !(largest >= 1e-30 && largest <= 1e30)) {
    throw std::invalid_argument("fit_obb: up must be finite with its largest component from 1e-30 to 1e30");
  }
  const Eigen::Vector3d scaled = up / largest;
  return scaled / std::sqrt(scaled.squaredNorm());
}

EstimationResult fit_pca(const PointView& points, Obb& box, const Execution& execution) {
  const CloudSummary summary = summarize(points, execution);
  if (summary.extremes.used > 0) box = measured_box(principal_axes(summary), points, execution);
  return summary.result();
}

EstimationResult fit_dito14(const PointView& points, Obb& box, const Execution& execution) {
  const Extremes extremes = find_extremes(points, DirectionSet::dop14, ExtremeDetail::points, execution);
  if (extremes.used > 0) {
    const LocalFrame frame(points, extremes);
    const Eigen::Matrix3d axes = dito_axes(few_points(points, extremes, frame), extremes, frame);
    const Aabb upright = aabb_of(extremes);
    if (!axes.isIdentity(0)) box = measured_box(axes, points, execution);
    if (box.empty() || !(box.surface_area() < upright.surface_area())) box = Obb(upright).canonical();
  }
  return result_of(extremes);
}

EstimationResult fit_minimal(const PointView& points, Obb& box, const Execution& execution) {
  const CloudSummary summary = summarize(points, execution);
  if (summary.extremes.used > 0) {
    const LocalFrame frame(points, summary.extremes);
    box = measured_box(minimal_axes(points, summary, frame, execution), points, execution);
  }
  return summary.result();
}

EstimationResult fit_upright(const PointView& points, const ObbOptions& options, Obb& box,
                             const Execution& execution) {
  const Eigen::Vector3d up = unit_up(options.up);
  const Extremes extremes = find_extremes(points, DirectionSet::dop26, ExtremeDetail::points, execution);
  if (extremes.used > 0) {
    const LocalFrame frame(points, extremes);
    const auto axes = options.method == ObbMethod::yaw ? yaw_axes : lshape_axes;
    box = measured_box(axes(points, extremes, frame, up, execution), points, execution);
  }
  return result_of(extremes);
}

}  // namespace

Obb measured_box(const Eigen::Matrix3d& axes, const PointView& points, const Execution& execution) {
  ProjectionSet set;
  for (int i = 0; i < 3; ++i)
    set.add({axes(0, i), axes(1, i), axes(2, i)});
  const ChunkFarthest farthest = find_farthest(points, set, execution);
  Eigen::Vector3d low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[static_cast<int>(i)] = project_down(set.exact[i], farthest.ends[2 * i].point);
    high[static_cast<int>(i)] = project_up(set.exact[i], farthest.ends[2 * i + 1].point);
  }
  return Obb::from_slabs(axes, low, high).canonical();
}

Eigen::Matrix3d principal_axes(const CloudSummary& summary) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(summary.covariance);
  Eigen::Matrix3d descending;
  descending << solver.eigenvectors().col(2), solver.eigenvectors().col(1), solver.eigenvectors().col(0);
  return orthonormal_axes(descending);
}

EstimationResult fit_obb(const PointView& points, const ObbOptions& options, Obb& box,
                         const Execution& execution) {
  const FloatEnvironment environment;
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

}  // namespace pcl_bv
