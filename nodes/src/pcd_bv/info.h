// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a cloud is like, for those who have to choose a range, a tolerance or a reader.
#pragma once

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// Looks at every point, three times. Box and spacing are of the valid points that are no dead beams (exactly
/// at 0,0,0). The spacing is the median, over up to 1000 of them evenly taken, of the exact distance to the
/// nearest other one; there is none of fewer than two. O(n) where spacings do not differ by much.
///
/// `header` has the fields and the size, `points` the coordinates.
CloudInfo cloud_info(const RawCloud& header, const PointView& points, const ParallelPolicy& policy);

}  // namespace pcl_bv
