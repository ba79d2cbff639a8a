// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <bit>
#include <new>
#include <string>

#include "input_file.h"
#include "pcl_bv/io/ply.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "ply_header.h"
#include "ply_vertices.h"

namespace pcl_bv {
namespace {

static_assert(std::endian::native == std::endian::little, "records are little-endian, as in the file");

RawCloud read_vertices(const InputFile& file, const ParallelPolicy& policy) {
  std::string start(std::min(file.size(), max_ply_header_size), '\0');
  file.read(0, start.data(), start.size());
  PlyHeader header = parse_ply_header(start);
  if (header.encoding == PlyEncoding::ascii) {
    read_ply_ascii(file, header, policy);
  } else {
    read_ply_binary(file, header);
  }
  update_packed_xyz(header.cloud);
  return std::move(header.cloud);
}

}  // namespace

RawCloud read_ply(const std::filesystem::path& path, const ParallelPolicy& policy) {
  const InputFile file(path);
  try {
    return read_vertices(file, policy);
  } catch (const std::bad_alloc&) {
    throw not_enough_memory(file);
  }
}

}  // namespace pcl_bv
