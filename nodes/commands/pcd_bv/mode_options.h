// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The options of pcd_bv that change what inputs are, and the options with which they cannot be combined.
#pragma once

#include <initializer_list>
#include <string>

#include "commands/shared/command_line.h"
#include "options.h"

namespace pcl_bv::detail {

/// Throws UsageError if one of the other options was given, too.
void reject_combinations(const CommandLine& line, const char* option,
                         std::initializer_list<const char*> others);

/// Throws UsageError for options that cannot work if several inputs are one cloud (labels, clusters, ground
/// and size limits). If partial results are made or merged, also rejects the options that cannot work with
/// partial results.
void reject_for_tiled_cloud(const CommandLine& line, const Options& options, PcdBvCommand command);

/// Sets the options of --update. Throws UsageError for options without effect: tilesets have no report.
void read_update(const CommandLine& line, Options& options);

/// Sets the options of --watch. Throws UsageError for options that need all inputs at the beginning or end,
/// and for outputs in the folder, which would be inputs again.
void read_watch(const CommandLine& line, const std::string& folder, const std::string& format,
                Options& options);

}  // namespace pcl_bv::detail
