// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Files that LASzip's own writer has compressed.
#pragma once

#include <cstdint>
#include <filesystem>

namespace pcl_bv {

/// Compresses a .las file, with so many points in each chunk.
void compress_las(const std::filesystem::path& las, const std::filesystem::path& laz,
                  std::uint32_t chunk_points = 50'000);

}  // namespace pcl_bv
