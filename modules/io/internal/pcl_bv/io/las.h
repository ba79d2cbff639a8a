// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reader of the ASPRS LAS format, versions 1.0 to 1.5, and of LAZ. Surveys and national scans use this
// format.
#pragma once

#include <array>
#include <filesystem>
#include <functional>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Reads the points of a .las file, point formats 0 to 10. The fields of the cloud are:
/// - x, y and z: doubles, X * scale + offset with each operation rounded once, in the file's unit and
///   coordinate system (mostly metres, UTM);
/// - intensity, return_number, number_of_returns, scan_direction_flag, edge_of_flight_line, classification
///   (without its flags), synthetic, key_point and withheld;
/// - overlap and scanner_channel in formats 6 to 10;
/// - point_source_id;
/// - gps_time, red, green and blue in the formats that have them.
///
/// All other values of the points are left out, such as scan angles, user data, near infrared, extra bytes
/// and waveforms. Of the variable length records, only the units of the coordinate system are read:
/// RawCloud::note says if they are feet or degrees. Coordinates stay in them.
///
/// Files of version 1.4 or later have a 64-bit count and a legacy count of points. The 64-bit count is used,
/// unless it is 0 and the format is 0 to 5. Then the legacy count is used. A legacy count that is neither 0
/// nor the 64-bit count is reported in RawCloud::note. Bytes after the last point that could be further
/// points are reported in the note, too. They are an error if the header says 0 points. The bounding box of
/// the header is ignored.
///
/// Compressed points (LAZ, also COPC) give the same cloud as the same points that are not compressed, in the
/// order of the file. The threads of `execution` decompress them. LAZ has no checksums: LASzip notices most
/// damage, but not all.
///
/// Throws IoError with the reason for a file that is missing, unreadable, empty, truncated, inconsistent
/// (points overlap extended records), compressed if !reads_laz(), or of another version or point format.
RawCloud read_las(const std::filesystem::path& path, const Execution& execution = {});

/// An axis-aligned box in the coordinates of the file.
struct LasBox {
  std::array<double, 3> low{}, high{};
};

/// Returns whether the caller needs none of the points of a box.
using BoxPredicate = std::function<bool(const LasBox&)>;

/// Reads like read_las() above, but saves time in a COPC file: it does not decompress nodes whose points are
/// in a box that `can_skip` accepts. Each point of such a node has the coordinates of the centre of its box,
/// and 0 in all other fields, so that number and order of the points stay. Nodes with more than 32 points per
/// byte may be decompressed nevertheless. If the tree of nodes is invalid, or its cube does not contain the
/// bounding box of the header, all points are read and RawCloud::note says so. In other files, `can_skip` has
/// no effect.
RawCloud read_las(const std::filesystem::path& path, const Execution& execution,
                  const BoxPredicate& can_skip);

/// Returns whether this build reads compressed points (LAZ), which needs LASzip.
bool reads_laz();

}  // namespace detail
}  // namespace pcl_bv
