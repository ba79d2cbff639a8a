// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of .bin sweeps, which have no header: the format of KITTI and nuScenes.
#pragma once

#include <cstddef>
#include <filesystem>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads a .bin file: each point is `fields` (3 to 32) little-endian float32. The values become the fields x,
/// y, z, intensity, ring, field6, field7 and so on. 0 means 5 fields for names that end in .pcd.bin
/// (nuScenes) and 4 for all others (KITTI).
///
/// The file does not state its number of fields. With `fields` 0, the number is checked for plausibility:
/// successive points of a scan are close to each other, so each value should differ little from the value one
/// record later. The file is refused if another number of fields fits clearly better (the error names this
/// number), or if most values are not coordinates (NaN, above 1e7, or below 1e-20 but not 0).
///
/// Throws IoError with the reason for an implausible number of fields and for a file that is missing,
/// unreadable, empty or of a size that is not a multiple of a record ("truncated"). Throws
/// std::invalid_argument if `fields` is neither 0 nor from 3 to 32.
RawCloud read_bin(const std::filesystem::path& path, std::size_t fields = 0);

}  // namespace pcl_bv
