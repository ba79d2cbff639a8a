// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "input_file.h"
#include "pcl_bv/io/pcd.h"

namespace pcl_bv {

/// A header must end within this many bytes; those of real files have some 200 to 400.
inline constexpr std::size_t max_pcd_header_size = 65536;

/// What the header says. The sizes are consistent and do not overflow, but may be greater than the file.
struct PcdHeader {
  RawCloud cloud;  ///< All but its points.
  PcdEncoding encoding = PcdEncoding::ascii;
  std::size_t data_offset = 0;  ///< Where the line DATA ended.
};

/// Reads the header at the front of `start`, the file's first bytes (at most max_pcd_header_size, fewer only
/// if the file ends there). Throws IoError.
PcdHeader parse_pcd_header(std::string_view start);

/// The same of an open file.
PcdHeader read_pcd_header(const InputFile& file);

/// The header of a file that holds the cloud. binary_compressed files have no padding fields.
std::string format_pcd_header(const RawCloud& cloud, PcdEncoding encoding);

}  // namespace pcl_bv
