// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Damaged databases of rosbag2, page by page.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "db3_pages.h"
#include "memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  static MemoryFile memory;
  memory.assign({reinterpret_cast<const char*>(data), size});
  try {
    const Db3Pages pages(memory.path());
    std::vector<std::byte> message;
    for (const Db3Pages::Message& row : pages.messages()) {
      try {
        pages.load(row, message);
        if (message.size() != row.size) std::abort();
      } catch (const IoError&) {
      }
    }
  } catch (const IoError&) {
  }
  return 0;
}
