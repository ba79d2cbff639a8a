// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of a cloud that is tiled over several inputs and can be larger than memory.
#pragma once

#include "options.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv::detail {

/// Finds the clusters of a cloud and fits the volumes. Sets the counts, the clusters and the times of the
/// report, which are those of the same cloud in memory. The points of `cloud` may be in files; they are read
/// two times, or three times with a filter. Throws as StoredClusters does, and passes on the errors of the
/// files.
void add_tiled_objects(const PointView& cloud, const Options& options, Report& report);

}  // namespace pcl_bv::detail
