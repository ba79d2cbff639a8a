// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include "pcl_bv/io/pcd.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv {

/// By PcdEncoding.
inline constexpr std::array pcd_encoding_names{"ascii", "binary", "binary_compressed"};

/// What the header says. The sizes are consistent and do not overflow, but may be greater than the file.
struct PcdHeader {
  RawCloud cloud;  ///< All but its points.
  PcdEncoding encoding = PcdEncoding::ascii;
  std::size_t data_offset = 0;  ///< Where the line DATA ended.
};

/// Throws IoError.
PcdHeader read_pcd_header(const InputFile& file);

/// The header that the points of a .bin would have in a binary .pcd; data_offset 0. As read_bin().
PcdHeader read_bin_header(const InputFile& file, const std::filesystem::path& path, std::size_t fields);

/// Throws IoError unless the file holds all records of a binary cloud; notes records behind them.
void require_records(const InputFile& file, PcdHeader& header);

/// Each reads the points behind the header into header.cloud.data. Throws IoError.
void read_ascii_points(const InputFile& file, PcdHeader& header, const ParallelPolicy& policy);
void read_compressed_points(const InputFile& file, PcdHeader& header);

/// The rows of all points. Throws IoError for a field that has no form as text.
std::string format_ascii_points(const RawCloud& cloud);

/// The block of all points, without padding fields: two sizes, then the packed bytes. Throws IoError if there
/// is too much to pack.
std::string compress_points(const RawCloud& cloud);

/// Throws IoError, saying what it is, for a name of a known format that holds no clouds or none that is read.
void refuse_other_formats(const std::filesystem::path& path);

}  // namespace pcl_bv
