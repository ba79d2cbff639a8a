// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

#include "options.h"
#include "status.h"

namespace pcl_bv::detail {

/// Returns whether --watch processes a file of this name: one that is not hidden and has an extension of a
/// cloud, of text only with columns.
bool is_watched_name(const std::filesystem::path& name, const Options& options);

/// Processes the files that arrive in the folder options.inputs.front(), one after another, until a signal:
/// each file that was closed after writing, or moved into the folder. Files that cannot be processed are
/// reported, and give Status::failed at the end. Throws IoError if the folder cannot be watched.
Status watch_folder(const Options& options);

}  // namespace pcl_bv::detail
