// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of the ASPRS LAS format, versions 1.0 to 1.5, the format of surveys and national scans.
#pragma once

#include <filesystem>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Reads the points of a .las file, point formats 0 to 10. x, y and z are doubles, X * scale + offset with
/// each operation rounded once, in the file's unit and coordinate system (mostly metres, UTM). The other
/// fields are intensity, return_number, number_of_returns, scan_direction_flag, edge_of_flight_line,
/// classification (without its flags), synthetic, key_point, withheld, in formats 6 to 10 also overlap and
/// scanner_channel, then point_source_id, and gps_time, red, green and blue where the format has them. Extra
/// bytes, waveforms and variable length records are left out.
///
/// From version 1.4 on, the 64-bit count is the number of points. A legacy count that differs is reported in
/// RawCloud::note; it is used only if the 64-bit count is 0 and the format is 0 to 5. Bytes after the last
/// point that could be further points are reported in the note; if the header says 0 points, they are an
/// error. The bounding box of the header is ignored.
///
/// Throws IoError with the reason for a file that is missing, unreadable, empty, truncated, inconsistent
/// (points overlap extended records), of another version or point format, or compressed (LAZ).
RawCloud read_las(const std::filesystem::path& path);

}  // namespace pcl_bv
