// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>

#include "pcl_bv/synth/town.h"

namespace pcl_bv::detail {

/// Writes the tiles of a town as .pcd files into an existing folder, on all threads. Each thread has one tile
/// in memory. Throws IoError, with the path, for the first file that cannot be written.
void write_town(const TownSequence& spec, const std::filesystem::path& folder);

}  // namespace pcl_bv::detail
