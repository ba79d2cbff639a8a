// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of a tiled cloud, distributed over ranks.
#pragma once

#include "commands/pcd_bv/options.h"
#include "commands/pcd_bv/status.h"
#include "commands/pcd_bv/tiles.h"
#include "distributed_jobs.h"
#include "pcl_bv/report/report.h"
#include "ranks.h"

namespace pcl_bv::detail {

/// A collective call. Each rank finds the clusters of its share and fits their volumes. The first rank joins
/// them and sets the report. Ranks pass files in a folder that the first rank makes in its folder of
/// temporary files ($TMPDIR), which all ranks must be able to access. An input that fails on any rank is
/// reported once and left out. Throws IoError on all ranks if no input is left or a file cannot be written. A
/// signal removes the folder.
Status find_merged_objects(Ranks& ranks, const Job& job, const Options& options, Report& report,
                           InterruptAction& interrupted);

}  // namespace pcl_bv::detail
