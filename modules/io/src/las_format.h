// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The header and the fields of .las files, and functions that read them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "laz_format.h"
#include "pcl_bv/io/las.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv::detail {

/// One field other than x, y and z.
struct LasColumn {
  std::size_t from, to;  ///< Offset in the file's record, and in the cloud's record.
  std::uint32_t size;    ///< Bytes: 1, 2 or 8.
  /// If `size` is 1, the field's value is (byte >> shift) & mask, because several fields can share a byte.
  unsigned shift, mask;
};

struct LasHeader {
  RawCloud cloud;  ///< The cloud without its points.
  std::vector<LasColumn> columns;
  std::size_t data_offset = 0;  ///< Byte offset of the first record in the file.
  std::size_t record = 0;       ///< Bytes of a record in the file.
  std::array<double, 3> scale{}, offset{};
  std::optional<LazLayout> laz;  ///< Set if the points are compressed.
};

/// Reads the header. Throws IoError if it is invalid.
LasHeader read_las_header(const InputFile& file);

/// Returns a warning if the records in the bytes [begin, end) of the file name a coordinate system in feet or
/// degrees, otherwise nothing. Reads at most 1 MiB.
std::string las_units_note(const InputFile& file, std::size_t begin, std::size_t end);

/// Converts a record of the file to a record of the cloud.
void convert_las_record(const std::byte* from, const LasHeader& header, std::byte* to);

/// Reads the points into header.cloud.data. Uses the threads of the policy for compressed points. Throws
/// IoError.
void read_las_points(const InputFile& file, LasHeader& header, const ParallelPolicy& policy);

}  // namespace pcl_bv::detail
