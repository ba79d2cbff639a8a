// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a .las file, whose points may be compressed. A compressed point can take much less than a bit,
// so headers with many points are read without the points.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "las_format.h"
#include "memory_file.h"
#include "pcl_bv/io/las.h"

namespace {

constexpr std::size_t kManyPoints = 1U << 15U;

pcl_bv::RawCloud read_header_or_all(const std::filesystem::path& path) {
  pcl_bv::RawCloud header = pcl_bv::detail::read_las_header(pcl_bv::detail::InputFile(path)).cloud;
  if (header.size() <= kManyPoints) return pcl_bv::detail::read_las(path, pcl_bv::Threads{2});
  header.width = 0;
  return header;
}

// Of COPC files only the nodes with x <= 0.
pcl_bv::RawCloud read_some(const std::filesystem::path& path) {
  const pcl_bv::RawCloud all = read_header_or_all(path);
  if (all.size() == 0) return all;
  pcl_bv::RawCloud some = pcl_bv::detail::read_las(
      path, pcl_bv::Threads{2}, [](const pcl_bv::detail::LasBox& box) { return box.low[0] > 0; });
  if (some.size() != all.size()) __builtin_trap();
  return some;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  pcl_bv::check_reader(content, kManyPoints, read_some);
  return 0;
}
