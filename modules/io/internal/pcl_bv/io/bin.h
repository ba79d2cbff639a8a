// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of .bin sweeps. They have no header. KITTI and nuScenes use this format.
#pragma once

#include <cstddef>
#include <filesystem>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Reads a .bin file, in which each point is `fields` (3 to 32) little-endian float32 values. The values
/// become the fields x, y, z, intensity, ring, field6, field7 and so on. If `fields` is 0, files whose name
/// ends in .pcd.bin (nuScenes) have 5 fields, and all others (KITTI) have 4.
///
/// The file does not state its number of fields. If `fields` is 0, the number is checked for plausibility.
/// Successive points of a scan are close to each other, so each value should differ little from the value one
/// record later. Points in random order differ much, but each value has a distribution of its own. The file
/// is refused if another number of fields fits clearly better (the error names the other number), or if most
/// values cannot be coordinates (NaN, a magnitude above 1e7, or a magnitude below 1e-20 other than 0).
///
/// Throws IoError with the reason for an implausible number of fields and for a file that is missing,
/// unreadable, empty or of a size that is not a multiple of a record ("truncated"). Throws
/// std::invalid_argument if `fields` is neither 0 nor from 3 to 32.
RawCloud read_bin(const std::filesystem::path& path, std::size_t fields = 0);

}  // namespace detail
}  // namespace pcl_bv
