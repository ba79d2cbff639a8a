// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Partial results for shares of a cloud in several inputs, and volumes from merged partial results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "pcl_bv/report/partial_file.h"
#include "pcl_bv/report/report.h"
#include "share_points.h"
#include "status.h"
#include "tiles.h"

namespace pcl_bv::detail {

/// Adds the points of a share to `file`. `range` holds the numbers of the points.
void add_share(const SharePoints& points, const PointRange& range, const Execution& execution,
               PartialFile& file);

/// Merges the partial results of the files. Reports each file that cannot be read or does not belong to the
/// other files. If there is such a file, returns nullopt.
std::optional<MergedClouds> merge_files(const std::vector<std::string>& files);

/// Returns a report of the whole cloud with an empty entry for the volume of each method.
Report report_of(const PartialFile& whole, const std::vector<const Method*>& methods);

/// Sets volume entry `index` of the report to the result of a fit. Also sets the counts, which are equal for
/// all methods.
void set_volume(std::size_t index, const EstimationResult& result, AnyVolume volume, Report& report);

/// Writes the file of --partial from the inputs, which are clouds or files of partial results.
Status make_partial_file(const Job& job, const Options& options);

/// Reports every excluded input. Returns Status::failed if there is one.
Status report_excluded_inputs(const Tiles& tiles);

/// Sets the list of excluded inputs.
void set_left_out(const Tiles& tiles, Report& report);

/// Reports the notes of all inputs that are not excluded.
void report_notes(const Tiles& tiles);

}  // namespace pcl_bv::detail
