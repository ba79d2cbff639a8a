// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Computes extents, centroid and covariance of a cloud in one pass over its memory.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/result.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Box, k-DOP, centroid and covariance of a cloud, in the points' unit and frame. Without a valid point,
/// centroid and covariance are zero and the volumes are empty.
struct CloudSummary : EstimationResult {
  Aabb aabb;   ///< The box of fit_aabb().
  Kdop dop26;  ///< The k-DOP of fit_kdop() along the 13 directions of KdopSet::dop26().

  /// Mean of the valid points, which is inside their box. For at most 2^b blocks of 1024 points, the error of
  /// a coordinate is at most (175 + 30 b) 2^-53 of the extent, plus one rounding of the coordinate.
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();

  /// Covariance of the valid points about their centroid, times covariance_scale². It is symmetric. It is the
  /// population covariance, divided by n, not n - 1. The error of entry (i, j) is at most 3 (175 + 30 b)
  /// 2^-53 of the product of the extents along i and j, plus 2^-1073 if the entry underflows. This factor is
  /// 6e-14 for one block, 2e-13 for 30 million points. Entries of an axis on which all points agree are
  /// exactly 0.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Factor by which the points were multiplied for the covariance. It is 1, except for clouds of doubles
  /// whose largest extent is below 1e-99. For these it is a larger power of two, because their squares could
  /// underflow. The eigenvectors of the covariance do not depend on this factor.
  double covariance_scale = 1;
};

/// Computes the box, the k-DOP, the centroid and the covariance of all valid points. O(n). Each chunk is read
/// from memory once, because it is still in the cache when its moments are computed after its extreme points.
/// The bits are the same for every execution. Another order of the points may round centroid and covariance
/// differently.
///
/// The covariance uses the shifted formula in blocks of 1024 points, with sums of squares about a point of
/// the block. The sums of the blocks are added in pairs (Chan, Golub, LeVeque 1983).
CloudSummary summarize(const PointView& points, const Execution& execution = {});

}  // namespace pcl_bv
