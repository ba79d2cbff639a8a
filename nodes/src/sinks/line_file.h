// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Text that others may read while it grows.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv {

/// Lines appended to a new file, or "-" for standard output, each by one write where the system takes it
/// whole.
class LineFile {
 public:
  /// Throws IoError if it cannot be opened.
  explicit LineFile(const std::filesystem::path& file);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Adds the line's end. Throws ClosedPipe (where SIGPIPE is ignored) and IoError.
  void write(std::string line);

  /// Throws IoError if the system says so late that something was not written.
  void close();

 private:
  int descriptor_;
  std::string name_;
};

}  // namespace pcl_bv
