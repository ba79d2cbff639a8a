// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of clouds that are processed in shares: files of partial results with --cluster, and their merging.
#pragma once

#include "inputs.h"
#include "options.h"
#include "pcl_bv/report/report.h"
#include "status.h"

namespace pcl_bv::detail {

/// Finds the clusters of the share that the options name, fits their volumes and writes the file of
/// --partial. Or, with --merge, writes all files to one. Reports problems on standard error.
Status make_object_file(const Job& job, const Options& options);

/// Merges the clusters of the files. Volumes are those of the files if they have the requested methods, and
/// are fitted if not. Reports each file that cannot be merged; then the report has an error.
Status merge_object_files(const Job& job, const Options& options, Report& report);

}  // namespace pcl_bv::detail
