// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a .npy file.
#include <cstddef>
#include <cstdint>

#include "memory_file.h"
#include "pcl_bv/io/numpy.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  pcl_bv::check_reader(content, 1, [](const auto& path) { return pcl_bv::detail::read_npy(path); });
  return 0;
}
