// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/read_cloud.h"

#include <algorithm>
#include <array>
#include <bit>
#include <new>
#include <utility>

#include "fields.h"
#include "las_format.h"
#include "npy_format.h"
#include "pcd_format.h"
#include "pcl_bv/io/bin.h"
#include "pcl_bv/io/las.h"
#include "pcl_bv/io/numpy.h"
#include "pcl_bv/io/ply.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/text_cloud.h"
#include "ply_format.h"

namespace pcl_bv {
using namespace detail;
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

void read_points(const InputFile& file, LasHeader& header, const ParallelPolicy& policy) {
  read_las_points(file, header, policy);
}

void read_points(const InputFile& file, NpyHeader& header, const ParallelPolicy&) {
  read_npy_points(file, header);
}

void read_points(const InputFile& file, PlyHeader& header, const ParallelPolicy& policy) {
  if (header.encoding == PlyEncoding::ascii) return read_ply_ascii(file, header, policy);
  read_ply_binary(file, header);
}

template <typename Header>
RawCloud& cloud_of(Header& header) {
  return header.cloud;
}

RawCloud& cloud_of(NpyHeader& header) {
  return header.records.cloud;
}

// Reads a cloud whose header is read by `read_header`.
template <typename ReadHeader>
RawCloud read_file(const std::filesystem::path& path, const ReadHeader& read_header,
                   const ParallelPolicy& policy) {
  const InputFile file(path);
  try {
    auto header = read_header(file);
    read_points(file, header, policy);
    RawCloud& cloud = cloud_of(header);
    update_packed_xyz(cloud);
    return std::move(cloud);
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

void detail::refuse_other_formats(const std::filesystem::path& path) {
  struct Kind {
    std::string_view extensions, what;
  };
  constexpr Kind kinds[] = {
      {" .obj .stl .off .gltf .glb .dae .3ds ",
       "is a mesh, not a cloud: sample it, for example with pcl_mesh_sampling"},
      {" .ptx ", "has a transform for each scan, which is not read: convert it to .las, .ply or .pts"},
      {" .e57 .rcp .rcs .fls .zfs ", "is a scanner's own format: convert it to .las, .ply or .pcd"},
      {" .bag .mcap .db3 .pcap .pcapng ",
       "is a recording, not a cloud: read it with open_recording() or RecordedClouds"}};
  const std::string extension = " " + lower_case_extension(path) + " ";
  for (const auto& [extensions, what] : kinds) {
    if (extensions.find(extension) == std::string_view::npos) continue;
    static_cast<void>(InputFile(path));  // throws the more useful reason if the file is missing or empty
    throw IoError(std::string(what));
  }
}

bool detail::is_text_name(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  constexpr std::array known{".xyz", ".txt", ".csv", ".asc", ".pts"};
  return std::find(known.begin(), known.end(), extension) != known.end();
}

bool is_cloud_name(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  constexpr std::array known{".pcd", ".ply", ".bin", ".las", ".laz"};
  return std::find(known.begin(), known.end(), extension) != known.end();
}

RawCloud read_pcd(const std::filesystem::path& path, const Execution& execution) {
  return read_file(path, read_pcd_header, execution.parallel);
}

RawCloud detail::read_ply(const std::filesystem::path& path, const Execution& execution) {
  return read_file(path, read_ply_header, execution.parallel);
}

RawCloud detail::read_bin(const std::filesystem::path& path, std::size_t fields) {
  const auto read_header = [&](const InputFile& file) { return read_bin_header(file, path, fields); };
  return read_file(path, read_header, Serial{});
}

RawCloud detail::read_las(const std::filesystem::path& path, const Execution& execution) {
  return read_file(path, read_las_header, execution.parallel);
}

RawCloud detail::read_las(const std::filesystem::path& path, const Execution& execution,
                          const BoxPredicate& can_skip) {
  const auto read_header = [&](const InputFile& file) {
    LasHeader header = read_las_header(file);
    mark_skipped_chunks(file, header, can_skip);
    return header;
  };
  return read_file(path, read_header, execution.parallel);
}

RawCloud detail::read_npy(const std::filesystem::path& path) {
  return read_file(path, read_npy_header, Serial{});
}

RawCloud detail::read_text_cloud(const std::filesystem::path& path, std::string_view columns,
                                 const Execution& execution) {
  const auto read_header = [&](const InputFile& file) { return read_text_header(file, columns); };
  return read_file(path, read_header, execution.parallel);
}

RawCloud read_cloud(const std::filesystem::path& path, const ReadOptions& options,
                    const Execution& execution) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".ply") return read_ply(path, execution);
  if (extension == ".bin") return read_bin(path, options.bin_fields);
  if (extension == ".las" || extension == ".laz") return read_las(path, execution);
  if (extension == ".npy") return read_npy(path);
  if (extension == ".npz") return read_npz(path);
  if (is_text_name(path)) return read_text_cloud(path, options.columns, execution);
  refuse_other_formats(path);
  return read_pcd(path, execution);
}

CloudHeader read_cloud_header(const std::filesystem::path& path, const ReadOptions& options) {
  const InputFile file(path);
  const std::string extension = lower_case_extension(path);
  CloudHeader header;
  if (extension == ".ply") {
    header.cloud = read_ply_header(file).cloud;
  } else if (extension == ".las" || extension == ".laz") {
    header.cloud = read_las_header(file).cloud;
  } else if (extension == ".npy") {
    NpyHeader array = read_npy_header(file);
    header.random_access = !array.by_column;
    header.cloud = std::move(array.records.cloud);
  } else if (extension == ".npz") {
    header.cloud = read_npz(path);  // the sizes are in the compressed array
    header.cloud.data = {};
  } else if (is_text_name(path)) {
    header.cloud = read_text_header(file, options.columns).cloud;
  } else {
    refuse_other_formats(path);
    PcdHeader pcd =
        extension == ".bin" ? read_bin_header(file, path, options.bin_fields) : read_pcd_header(file);
    header.random_access = pcd.encoding == PcdEncoding::binary;
    if (header.random_access) require_records(file, pcd);
    header.cloud = std::move(pcd.cloud);
  }
  header.scalar = coordinate_fields(header.cloud.fields).scalar;
  return header;
}

}  // namespace pcl_bv
