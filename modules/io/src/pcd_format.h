// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The header of .pcd files, and functions that read and write their points. A .bin file has no header. It
// gets one that describes it as a binary .pcd file.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::detail {

/// Names of the encodings in the line DATA, indexed by PcdEncoding.
inline constexpr std::array pcd_encoding_names{"ascii", "binary", "binary_compressed"};

/// A parsed header. Its sizes are consistent and do not overflow, but may exceed the size of the file.
struct PcdHeader {
  RawCloud cloud;  ///< The cloud without its points.
  PcdEncoding encoding = PcdEncoding::ascii;
  std::size_t data_offset = 0;  ///< Byte offset of the points, which is the end of the line DATA.
  char separator = ' ';         ///< Between values of ascii points, see separate_by_blanks().
};

/// Reads the header. Throws IoError if it is invalid.
PcdHeader read_pcd_header(const InputFile& file);

/// Returns a header that describes a .bin file as a binary .pcd with data_offset 0. Throws as read_bin().
PcdHeader read_bin_header(const InputFile& file, const std::filesystem::path& path, std::size_t fields);

/// Returns a header that describes a text file as an ascii .pcd. Counts the rows of the file. Throws as
/// read_text_cloud().
PcdHeader read_text_header(const InputFile& file, std::string_view columns);

/// Throws IoError unless the file has all records of a binary cloud. Adds a note if more records follow.
void require_records(const InputFile& file, PcdHeader& header);

/// read_ascii_points() and read_compressed_points() read the points behind the header into header.cloud.data.
/// They throw IoError.
void read_ascii_points(const InputFile& file, PcdHeader& header, const ParallelPolicy& policy);
void read_compressed_points(const InputFile& file, PcdHeader& header);

/// Returns the text rows of all points. Throws IoError for floating-point fields of 1 or 2 bytes.
std::string format_ascii_points(const RawCloud& cloud);

/// Returns the compressed block of all points, without padding fields. It begins with two sizes, and the
/// compressed bytes follow. Throws IoError if there are more than 4e9 bytes to compress.
std::string compress_points(const RawCloud& cloud);

/// Throws IoError with advice if the path has the extension of another known format (mesh, recording, ...).
void refuse_other_formats(const std::filesystem::path& path);

}  // namespace pcl_bv::detail
