// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdlib>

#include "formats.h"
#include "memory_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
using namespace detail;

/// Reads any bytes as a recording: its topics are there, and every byte of its messages can be read.
inline void read_recording(const std::uint8_t* data, std::size_t size,
                           std::unique_ptr<RecordingReader> (*open)(const std::filesystem::path&)) {
  static MemoryFile file;
  file.assign({reinterpret_cast<const char*>(data), size});
  try {
    const auto reader = open(file.path());
    unsigned sum = 0;
    for (RecordedMessage message; reader->next(message);) {
      if (message.topic >= reader->topics().size()) std::abort();
      for (std::size_t i = 0; i < message.size; ++i)
        sum += std::to_integer<unsigned>(message.data[i]);
    }
    [[maybe_unused]] static volatile unsigned seen;
    seen = sum;  // so that all is read
  } catch (const IoError& error) {
    if (*error.what() == 0) std::abort();
  }
}

}  // namespace pcl_bv
