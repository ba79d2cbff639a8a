// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of the ASPRS LAS format, versions 1.0 to 1.5, as surveys and national scans come.
#pragma once

#include <filesystem>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads the points of a .las file, point formats 0 to 10: x, y and z as doubles, X * scale + offset with
/// each step rounded once, in the file's unit and coordinate system (mostly metres, UTM), then intensity,
/// return_number, number_of_returns, scan_direction_flag, edge_of_flight_line, classification (without its
/// flags), synthetic, key_point, withheld, in formats 6 to 10 overlap and scanner_channel, point_source_id,
/// and gps_time, red, green and blue where the format has them. Extra bytes, waveforms and variable length
/// records are left out.
///
/// From 1.4 on the count of 64 bits says how many points there are; another legacy count is noted, and
/// taken only if the former is 0 and the format one of 0 to 5. Bytes of more points behind the last one are
/// noted, and an error if the header says 0 points. The box in the header is not read.
///
/// Throws IoError, naming the reason, for a file that is missing, unreadable, empty, truncated, inconsistent
/// (with points that reach into extended records), of another version or format, or compressed (LAZ).
RawCloud read_las(const std::filesystem::path& path);

}  // namespace pcl_bv
