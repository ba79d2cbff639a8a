// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/read_cloud.h"

#include <bit>
#include <new>
#include <utility>

#include "pcd_format.h"
#include "pcl_bv/io/kitti_bin.h"
#include "pcl_bv/io/pcd.h"
#include "pcl_bv/io/ply.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "ply_format.h"

namespace pcl_bv {
namespace {

static_assert(std::endian::native == std::endian::little, "records are used as they are in the file");

void read_records(const InputFile& file, PcdHeader& header) {
  require_records(file, header);
  RawCloud& cloud = header.cloud;
  cloud.data.resize(cloud.size() * cloud.point_step);
  file.read(header.data_offset, cloud.data.data(), cloud.data.size());
}

void read_points(const InputFile& file, PcdHeader& header, const ParallelPolicy& policy) {
  switch (header.encoding) {
    case PcdEncoding::ascii:
      return read_ascii_points(file, header, policy);
    case PcdEncoding::binary:
      return read_records(file, header);
    case PcdEncoding::binary_compressed:
      return read_compressed_points(file, header);
  }
}

void read_points(const InputFile& file, PlyHeader& header, const ParallelPolicy& policy) {
  if (header.encoding == PlyEncoding::ascii) return read_ply_ascii(file, header, policy);
  read_ply_binary(file, header);
}

// The cloud of a file whose header is read by `read_header`.
template <typename Header>
RawCloud read_file(const std::filesystem::path& path, Header (*read_header)(const InputFile&),
                   const ParallelPolicy& policy) {
  const InputFile file(path);
  try {
    Header header = read_header(file);
    read_points(file, header, policy);
    update_packed_xyz(header.cloud);
    return std::move(header.cloud);
  } catch (const std::bad_alloc&) {
    throw IoError("not enough memory for its points, file of " + std::to_string(file.size()) + " bytes");
  }
}

}  // namespace

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

bool is_cloud_name(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  return extension == ".pcd" || extension == ".ply" || extension == ".bin";
}

RawCloud read_pcd(const std::filesystem::path& path, const ParallelPolicy& policy) {
  return read_file(path, read_pcd_header, policy);
}

RawCloud read_ply(const std::filesystem::path& path, const ParallelPolicy& policy) {
  return read_file(path, read_ply_header, policy);
}

RawCloud read_kitti_bin(const std::filesystem::path& path) {
  return read_file(path, kitti_header, Serial{});
}

RawCloud read_cloud(const std::filesystem::path& path, const ParallelPolicy& policy) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".ply") return read_ply(path, policy);
  if (extension == ".bin") return read_kitti_bin(path);
  return read_pcd(path, policy);
}

}  // namespace pcl_bv
