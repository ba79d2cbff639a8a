// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The header of .ply files, and functions that read the vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/execution.h"

namespace pcl_bv::detail {

/// A property is one value or a list. In the file, a list is a count, then the values.
struct PlyProperty {
  PointField value;  ///< Name, type and size of the value, or of a list's values.
  PointField count;  ///< Type and size of a list's count.
  bool is_list = false;
  /// Returns the minimum size in a binary file, which is the size of a list without values.
  std::size_t fixed_bytes() const { return is_list ? count.size : value.size; }
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const;
  std::size_t fixed_bytes() const;  ///< Minimum size of one element in a binary file, without list values.
};

enum class PlyEncoding { ascii, little_endian, big_endian };

/// A parsed header, without the elements after the vertices. Its sizes have not been checked against the size
/// of the file.
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> skipped;  ///< Elements before the vertices.
  PlyElement vertex;
  bool vertices_are_last = false;  ///< No element follows the vertices.
  RawCloud cloud;                  ///< Fields and size. Each property that is not a list is a field.
  std::size_t data_offset = 0;     ///< Byte offset of the data, which is the end of the line end_header.
};

/// Returns the name of a property's type, such as "float".
std::string_view ply_type_name(const PointField& value);

/// Reads the header. Throws IoError if it is invalid.
PlyHeader read_ply_header(const InputFile& file);

/// read_ply_ascii() and read_ply_binary() read the vertices into header.cloud.data, without lists. They throw
/// IoError.
void read_ply_ascii(const InputFile& file, PlyHeader& header, const ParallelPolicy& policy);
void read_ply_binary(const InputFile& file, PlyHeader& header);

}  // namespace pcl_bv::detail
