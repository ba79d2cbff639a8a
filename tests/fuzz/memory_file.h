// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Readers take paths and read by position: a file in memory is one that they cannot tell from another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv {
using namespace detail;

/// A file that lives as long as this.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  void assign(std::string_view content);
  std::filesystem::path path() const;

 private:
  int fd_;
};

using Reader = std::function<RawCloud(const std::filesystem::path&)>;

/// Reads the content; ends the process if anything but a whole cloud or an IoError of one printable line
/// comes out, or if the cloud takes more memory than a file of that size may ask for: `expansion` bytes for
/// each of its own.
void check_reader(std::string_view content, std::size_t expansion, const Reader& read);

}  // namespace pcl_bv
