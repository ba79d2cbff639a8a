// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A text file that other programs may read while it grows.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv::detail {

/// A text file, or standard output for "-". Each write() is one system call if the system takes the whole
/// text. The first call of write() or close() empties an existing file. Without such a call, an existing file
/// is unchanged.
class LineFile {
 public:
  /// Throws IoError if the file cannot be opened.
  explicit LineFile(const std::filesystem::path& file);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Appends `text` and `tail`. If the previous call of write() had a tail, overwrites that tail. Throws
  /// IoError if the text cannot be written. If SIGPIPE is ignored, throws ClosedPipe for a pipe without a
  /// reader.
  void write(std::string text, std::string_view tail = {});

  /// Closes the file. Throws IoError if the system only now reports an error of writing.
  void close();

 private:
  void begin();

  int descriptor_;
  off_t tail_ = 0;
  // The file, if this object created it and has not written it yet. The destructor then removes the file.
  std::filesystem::path created_;
  bool begun_ = false;
};

}  // namespace pcl_bv::detail
