// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which nodes of a COPC file need not be decompressed.
#pragma once

#include "inputs.h"
#include "options.h"
#include "pcl_bv/io/las.h"
#include "pcl_bv/nodes/pipeline_config.h"

namespace pcl_bv::detail {

/// Returns which boxes have only points that the filter drops for the same reason as the centre of the box.
/// So the results and counts are those of all points. Margins cover the rounding of distances. Reads files of
/// regions. Throws IoError if a file cannot be read.
SkipsBox boxes_without_kept_points(const FilterConfig& filter);

/// Returns the boxes that process() does not need. Returns an empty function if it needs all points: for
/// other files than .laz, for results with points that the filter drops, if the filter keeps most points, and
/// if the points are moved or have classes.
SkipsBox unneeded_boxes(const Job& job, const Options& options);

}  // namespace pcl_bv::detail
