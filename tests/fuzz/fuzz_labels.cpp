// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Any bytes as a file of volumes or of boxes of other programs. fuzz_nested reads the same as deep and long
// texts.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "memory_file.h"
#include "pcl_bv/report/read_volumes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pcl_bv;
  using namespace pcl_bv::detail;
  static MemoryFile memory;
  memory.assign({reinterpret_cast<const char*>(data), size});
  try {
    for (const AnyVolume& volume : read_volumes(memory.path()))
      if (empty(volume)) std::abort();
  } catch (const IoError& error) {
    const std::string_view said = error.what();
    if (std::any_of(said.begin(), said.end(), [](char c) { return c >= 0 && c < ' '; })) std::abort();
  }
  return 0;
}
