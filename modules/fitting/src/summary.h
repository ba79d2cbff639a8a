// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/moments.h"

namespace pcl_bv::detail {

/// Supports, centroid and covariance of a cloud, with the meaning of CloudSummary.
struct Summary {
  Supports supports;  ///< With dop26 and SupportDetail::points, except after summarize_bounds().
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double covariance_scale = 1;

  EstimationResult result() const { return result_of(supports); }
};

/// Computes the summary of pcl_bv::summarize(). Needs a FloatEnvironment.
Summary summarize(const PointView& points, const FitExecution& execution);

/// Computes the summary of summarize(), but its supports may have only dop6 and SupportDetail::bounds. For
/// 300 points this is three times as fast. Needs a FloatEnvironment.
Summary summarize_bounds(const PointView& points, const FitExecution& execution);

/// Same for at most kBlockPoints points in memory, all of the cloud. Also stores the offsets of the points
/// from the first valid point.
Summary summarize_few(const PointView& points, BlockOffsets& offsets, const FitExecution& execution);

}  // namespace pcl_bv::detail
