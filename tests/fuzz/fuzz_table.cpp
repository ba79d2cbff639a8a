// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a plain text file: "1 " is a double of 8 bytes.
#include <cstddef>
#include <cstdint>

#include "memory_file.h"
#include "pcl_bv/io/text_cloud.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  pcl_bv::check_reader(content, 5, [](const auto& path) { return pcl_bv::detail::read_text_cloud(path); });
  return 0;
}
