// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of a cloud that is tiled over several inputs and can be larger than memory.
#pragma once

#include "inputs.h"
#include "options.h"
#include "pcl_bv/report/report.h"
#include "status.h"

namespace pcl_bv::detail {

/// Finds the clusters of a tiled cloud, fits the volumes and writes the mesh. The report has what it has for
/// the same cloud in memory. Problems with volumes and files are reported on standard error and change the
/// status. Throws TileError for an input that fails, and as StoredClusters does.
Status process_tiled_objects(const Job& job, const Options& options, Report& report);

}  // namespace pcl_bv::detail
