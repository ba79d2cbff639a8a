// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What many algorithms ask of a cloud first, in one pass over its memory: how far it reaches, where its
// middle is, how it spreads.
#pragma once

#include <Eigen/Core>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/result.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// In the points' unit and frame. Without a valid point centroid and covariance are zero, the volumes empty.
struct CloudSummary {
  /// Along the 26 directions, with points; `used` and `dropped` are in here.
  Supports supports;

  /// The mean of the valid points, inside their box. Of at most 2^b blocks of 1024 points, off by at most
  /// (175 + 30 b) 2^-53 of the extent and a rounding of the coordinate itself.
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();

  /// Of the valid points about their centroid, as a population (divided by n, not n - 1), symmetric, times
  /// scale². Entry (i, j) is off by at most 3 (175 + 30 b) 2^-53 of the product of the extents along i and j:
  /// 6e-14 in one block, 2e-13 for 30 million points (and by 2^-1073, where it underflows). Exactly 0 along
  /// an axis on which all points agree.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// 1, except for doubles whose greatest extent is below 1e-99, whose squares could vanish: a power of two
  /// by which the points were multiplied for the covariance. Its eigenvectors do not depend on it.
  double scale = 1;

  Aabb aabb() const { return aabb_of(supports); }
  Kdop dop26() const { return kdop_of(supports); }

  EstimationResult result() const { return result_of(supports); }
};

/// Supports, centroid and covariance of all valid points. O(n); each chunk is read from memory once, as it is
/// still in the cache when the moments follow the supports. The same bits for every execution; another order
/// of the points may round centroid and covariance otherwise.
///
/// Covariance by the shifted formula in blocks of 1024 points, sums of squares about a point of the block,
/// which are added up pair by pair (Chan, Golub, LeVeque 1983).
CloudSummary summarize(const PointView& points, const Execution& execution = {});

}  // namespace pcl_bv
