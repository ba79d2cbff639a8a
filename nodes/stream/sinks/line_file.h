// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Text that others may read while it grows.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv {

/// A new file, or "-" for standard output, that grows by one write() a time where the system takes it whole.
/// What was there before is replaced by the first write() or by close(): without either, nothing has changed.
class LineFile {
 public:
  /// Throws IoError if it cannot be opened.
  explicit LineFile(const std::filesystem::path& file);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends the text in place of the last call's tail, which ended the file until now, and its own tail.
  /// Throws ClosedPipe (where SIGPIPE is ignored) and IoError.
  void write(std::string text, std::string_view tail = {});

  /// Throws IoError if the system says so late that something was not written.
  void close();

 private:
  void begin();

  int descriptor_;
  off_t tail_ = 0;
  std::filesystem::path made_;  // the file, if it was not there before, until something is in it
  bool begun_ = false;
};

}  // namespace pcl_bv
