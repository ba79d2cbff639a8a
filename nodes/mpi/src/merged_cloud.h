// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to one cloud that is distributed over all ranks.
#pragma once

#include <cstddef>

#include "commands/pcd_bv/options.h"
#include "commands/pcd_bv/status.h"
#include "commands/pcd_bv/tiles.h"
#include "pcl_bv/report/report.h"
#include "ranks.h"

namespace pcl_bv::detail {

/// A collective call. Fits each method to the points of all tiles.
///
/// - Methods for which Partial::can_fit() holds are fitted to the merged partial results of all ranks.
///   Exception: `sphere-exact` of more than Partial::kMaxStored points is fitted by rounds of queries to all
///   ranks.
/// - Each method that needs all points is fitted on one rank, which reads all points.
///
/// If an input fails on any rank, all ranks start again without this input. `report` and the returned status
/// are meaningful on the first rank only. Throws IoError on all ranks if no input can be read.
Status fit_merged(Ranks& ranks, Tiles& tiles, const Options& options, Report& report);

}  // namespace pcl_bv::detail
