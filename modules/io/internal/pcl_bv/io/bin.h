// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of sweeps without a header: KITTI's, nuScenes', and those of all who write theirs in the same way.
#pragma once

#include <cstddef>
#include <filesystem>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads a .bin file: records of `fields` little-endian float32, from 3 to 32, which become the fields x, y,
/// z, intensity, ring, field6, field7 and so on; 0 means 5 for names that end in .pcd.bin (nuScenes), else 4
/// (KITTI).
///
/// The format cannot say how many there are. With 0, the file is held against what scans are like: points
/// that follow one another are near one another, so values differ least from those one record on. Where that
/// holds clearly of another number of floats, or where most values are no coordinates (NaN, beyond 1e7, or
/// smaller than 1e-20 but not 0), the file is refused, with the number to try.
///
/// Throws IoError, naming the reason, for that and for a file that is missing, unreadable, empty or of a size
/// that is no multiple of a record ("truncated"); std::invalid_argument for another number of fields.
RawCloud read_bin(const std::filesystem::path& path, std::size_t fields = 0);

}  // namespace pcl_bv
