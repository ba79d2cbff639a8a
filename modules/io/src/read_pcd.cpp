// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <new>
#include <utility>

#include "binary_points.h"
#include "input_file.h"
#include "pcd_ascii.h"
#include "pcd_compressed.h"
#include "pcd_header.h"
#include "pcl_bv/io/pcd.h"
#include "pcl_bv/io/raw_cloud_edit.h"

namespace pcl_bv {
namespace {

RawCloud read_points(const InputFile& file, const ParallelPolicy& policy) {
  PcdHeader header = read_pcd_header(file);
  switch (header.encoding) {
    case PcdEncoding::ascii:
      read_ascii_points(file, header.data_offset, header.cloud, policy);
      break;
    case PcdEncoding::binary:
      require_points(file, header.data_offset, header.cloud);
      return read_points(file, {std::move(header.cloud), header.data_offset});
    case PcdEncoding::binary_compressed:
      read_compressed_points(file, header.data_offset, header.cloud);
      break;
  }
  update_packed_xyz(header.cloud);
  return std::move(header.cloud);
}

}  // namespace

RawCloud read_pcd(const std::filesystem::path& path, const ParallelPolicy& policy) {
  const InputFile file(path);
  try {
    return read_points(file, policy);
  } catch (const std::bad_alloc&) {
    throw not_enough_memory(file);
  }
}

}  // namespace pcl_bv
