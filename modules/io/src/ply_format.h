// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/io/posix_file.h"

namespace pcl_bv {

/// A property is one value, or a list: a count, itself a value, and that many values.
struct PlyProperty {
  PointField value;  ///< Name, type and size; of the elements if it is a list.
  PointField count;  ///< Type and size of a list's count.
  bool is_list = false;
  std::size_t fixed_bytes() const { return is_list ? count.size : value.size; }  ///< At least, in binary.
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_lists() const;
  std::size_t fixed_bytes() const;  ///< Of one of them, without the elements of lists.
};

enum class PlyEncoding { ascii, little_endian, big_endian };

/// What the header says of the data up to the vertices; the elements after them are left out. Nothing has
/// been held against the size of the file.
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> skipped;  ///< Before the vertices.
  PlyElement vertex;
  bool vertices_are_last = false;
  RawCloud cloud;               ///< Fields and size: a field for each property that is no list.
  std::size_t data_offset = 0;  ///< Where the line end_header ended.
};

/// The name of a property's type: "float".
std::string_view ply_type_name(const PointField& value);

/// Throws IoError.
PlyHeader read_ply_header(const InputFile& file);

/// Each reads the data of the vertices into header.cloud.data; lists are left out. Throws IoError.
void read_ply_ascii(const InputFile& file, PlyHeader& header, const ParallelPolicy& policy);
void read_ply_binary(const InputFile& file, PlyHeader& header);

}  // namespace pcl_bv
