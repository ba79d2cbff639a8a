// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cstdlib>

#include "formats.h"
#include "memory_file.h"
#include "pcl_bv/io/io_error.h"

// Any bytes as a recording: its messages lie in what was read, and are no more than a file of that size can
// hold.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static pcl_bv::MemoryFile file;
  file.assign({reinterpret_cast<const char*>(data), size});
  try {
    const auto reader = pcl_bv::open_bag(file.path());
    unsigned sum = 0;
    for (pcl_bv::RecordedMessage message; reader->next(message);) {
      if (message.topic >= reader->topics().size()) std::abort();
      for (std::size_t i = 0; i < message.size; ++i)
        sum += std::to_integer<unsigned>(message.data[i]);
    }
    if (sum == 1'234'567) return 1;  // so that all is read
  } catch (const pcl_bv::IoError& error) {
    if (*error.what() == 0) std::abort();
  }
  return 0;
}
