// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One file for each of the sinks that the table names.
#pragma once

#include "pcl_bv/nodes/frame_sink.h"

namespace pcl_bv {

std::unique_ptr<FrameSink> open_jsonl(const SinkDescription& description);
std::unique_ptr<FrameSink> open_csv(const SinkDescription& description);
std::unique_ptr<FrameSink> open_vtp(const SinkDescription& description);
std::unique_ptr<FrameSink> open_image(const SinkDescription& description);
std::unique_ptr<FrameSink> open_labels(const SinkDescription& description);

/// The files that a sink writes one by one.
class FrameFiles {
 public:
  /// Makes the folder; throws IoError.
  explicit FrameFiles(const SinkDescription& description);

  /// frame000012.vtp; `stem` in place of "frame".
  std::string name(const FrameHeader& header, std::string_view stem = "frame") const;
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::filesystem::path path(const FrameHeader& header) const { return path(name(header)); }

 private:
  std::filesystem::path folder_;
  std::string_view extension_;
};

}  // namespace pcl_bv
