// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as the LZF stream of a .pcd file whose sizes are right, so that they reach the unpacking. The
// first byte is the number of points.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "memory_file.h"
#include "pcl_bv/io/read_cloud.h"

namespace {

std::string compressed_file(std::size_t points, std::string_view stream) {
  constexpr std::size_t point_step = 13;
  const std::uint32_t sizes[2] = {static_cast<std::uint32_t>(stream.size()),
                                  static_cast<std::uint32_t>(points * point_step)};
  std::string file = "VERSION 0.7\nFIELDS x y z a\nSIZE 4 4 4 1\nTYPE F F F U\nWIDTH " +
                     std::to_string(points) + "\nHEIGHT 1\nDATA binary_compressed\n";
  file.append(reinterpret_cast<const char*>(sizes), sizeof sizes);
  return file.append(stream);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view stream(reinterpret_cast<const char*>(data) + 1, size - 1);
  pcl_bv::check_reader(compressed_file(data[0], stream), 88,
                       [](const auto& path) { return pcl_bv::read_pcd(path); });
  return 0;
}
