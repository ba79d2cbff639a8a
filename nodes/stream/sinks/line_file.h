// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A text file that others may read while it grows.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv {

/// A new file, or standard output for "-". Each write() is one write of the system, if the system takes it
/// whole. The first write() or close() replaces the previous content; without either, the file is unchanged.
class LineFile {
 public:
  /// Throws IoError if it cannot be opened.
  explicit LineFile(const std::filesystem::path& file);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends `text` and `tail`; overwrites the tail of the previous call, which ended the file until now.
  /// Throws ClosedPipe (if SIGPIPE is ignored) and IoError.
  void write(std::string text, std::string_view tail = {});

  /// Closes the file. Throws IoError if the system reports only now that something was not written.
  void close();

 private:
  void begin();

  int descriptor_;
  off_t tail_ = 0;
  std::filesystem::path created_;  // a file that was created here and is still empty; removed at the end
  bool begun_ = false;
};

}  // namespace pcl_bv
