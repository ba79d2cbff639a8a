// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of the sweeps of the KITTI data set and of those who write theirs in the same way.
#pragma once

#include <filesystem>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads a .bin file: records of four little-endian float32, which become the fields x, y, z and intensity.
/// The format has no header, so any file of a fitting size gives a cloud.
///
/// Throws IoError, naming the reason, for a file that is missing, unreadable, empty or of a size that is no
/// multiple of 16 ("truncated").
RawCloud read_kitti_bin(const std::filesystem::path& path);

}  // namespace pcl_bv
