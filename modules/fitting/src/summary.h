// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"

namespace pcl_bv::detail {

/// Supports, centroid and covariance of a cloud, with the meaning of CloudSummary.
struct Summary {
  Supports supports;  ///< Along dop26, with points. Those of summarize_bounds() may be along dop6 only.
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double covariance_scale = 1;

  EstimationResult result() const { return result_of(supports); }
};

/// Computes the summary of pcl_bv::summarize(). Needs a FloatEnvironment.
Summary summarize(const PointView& points, const FitExecution& execution);

/// As summarize(), but the supports may be along dop6 only and have no points. For 300 points this is three
/// times as fast. Needs a FloatEnvironment.
Summary summarize_bounds(const PointView& points, const FitExecution& execution);

}  // namespace pcl_bv::detail
