// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a .pcd file. LZF makes at most 88 bytes of one; text 4, "1 " as a float64.
#include <cstddef>
#include <cstdint>

#include "memory_file.h"
#include "pcl_bv/io/read_cloud.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  pcl_bv::check_reader(content, 88, [](const auto& path) { return pcl_bv::read_pcd(path); });
  return 0;
}
