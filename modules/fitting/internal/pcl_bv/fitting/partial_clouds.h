// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes around several clouds whose partial results were computed independently.
#pragma once

#include <vector>

#include "pcl_bv/fitting/partial.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the points of all clouds as one cloud, in the order of the list. Each Partial must have all points
/// of its cloud, with the numbers 0 to size() - 1. If one has double coordinates, the result has double
/// coordinates. Volumes of the result have the bits of those of a Partial of the one cloud, with one
/// exception: of more than kMaxStored points, the sums for the covariance are added cloud by cloud. So the
/// last bits of obb-pca, and of best if it selects obb-pca, can differ. The result is for fit() only: it must
/// neither be merged nor written. O(m log m) for m extreme points of all clouds.
Partial join_clouds(const std::vector<Partial>& clouds);

}  // namespace detail
}  // namespace pcl_bv
