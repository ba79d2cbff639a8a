// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of the ASPRS LAS format, versions 1.2 to 1.4, as surveys and national scans come.
#pragma once

#include <filesystem>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads the points of a .las file, point formats 0 to 10: x, y and z as doubles, X * scale + offset with
/// each step rounded once, in the file's unit and coordinate system (mostly metres, UTM), then intensity,
/// returns, classification, point_source_id as they are in the record, and gps_time, red, green and blue
/// where the format has them. Extra bytes, waveforms and variable length records are left out.
///
/// Throws IoError, naming the reason, for a file that is missing, unreadable, empty, truncated, inconsistent,
/// of another version or format, or compressed (LAZ).
RawCloud read_las(const std::filesystem::path& path);

}  // namespace pcl_bv
