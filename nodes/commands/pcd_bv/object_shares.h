// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Objects of clouds that are processed in shares: files of partial results with --cluster, and their merging.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ground_parts.h"
#include "inputs.h"
#include "options.h"
#include "pcl_bv/report/object_file.h"
#include "pcl_bv/report/report.h"
#include "status.h"
#include "tiles.h"

namespace pcl_bv::detail {

/// Finds the clusters of a share, fits their volumes and writes them to a file. Throws TileError for an input
/// that fails, and std::runtime_error if a file cannot be written. Points of the ground are left out.
void write_object_share(const Tiles& tiles, const ShareOption& share, const Options& options,
                        const std::optional<CloudGround>& ground, const std::filesystem::path& path);

/// As write_object_share(), for a file that is merged with those of all other shares by the same run of a
/// program. Only what this needs is written (ShareRecords::gather). `gather` is not called if the options
/// need all records.
void write_temporary_object_share(const Tiles& tiles, const ShareOption& share, const Options& options,
                                  const std::optional<CloudGround>& ground, const std::filesystem::path& path,
                                  const GatherCells& gather);

bool needs_all_records(const Options& options);

/// Writes the shares of all files to the file of --partial. Reports each file that does not belong to the
/// others; then returns false.
bool join_object_files(const std::vector<std::string>& files, const Options& options);

/// Merges the clusters of the files. Volumes are those of the files if they have the requested methods, and
/// are fitted if not. Writes the points of the objects if the job says so. Reports each file that cannot be
/// merged; then the report has an error. Damaged points of lasting files are left out, and reported; then
/// returns Status::failed. All reports come from the calling thread. Volumes that could not be fitted are not
/// reported.
Status merge_object_files(const Job& job, const std::vector<std::string>& files, FileLife life,
                          const Options& options, Report& report);

}  // namespace pcl_bv::detail
