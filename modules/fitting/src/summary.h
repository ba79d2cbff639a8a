// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/moments.h"

namespace pcl_bv::detail {

/// Centroid and covariance of a cloud, with the meaning of CloudSummary.
struct CentroidAndCovariance {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double covariance_scale = 1;
};

/// Supports, centroid and covariance of a cloud.
struct Summary : CentroidAndCovariance {
  Supports supports;  ///< With dop26 and SupportDetail::points, except after summarize_bounds().

  EstimationResult result() const { return result_of(supports); }
};

/// Computes the summary of pcl_bv::summarize(). Needs a FloatEnvironment.
Summary summarize(const PointView& points, const FitExecution& execution);

/// Computes the summary of summarize(), but its supports may have only dop6 and SupportDetail::bounds. For
/// 300 points this is three times as fast. Needs a FloatEnvironment.
Summary summarize_bounds(const PointView& points, const FitExecution& execution);

/// Returns the centroid and the covariance of points with these moments and supports. Without points, zeros.
CentroidAndCovariance centroid_and_covariance(Moments moments, const Supports& supports);

}  // namespace pcl_bv::detail
