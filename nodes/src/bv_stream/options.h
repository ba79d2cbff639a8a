// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command line of bv_stream, checked whole before any frame is read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pcl_bv/nodes/frame_sink.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/nodes/stream_config.h"

namespace pcl_bv {

struct StreamOptions {
  std::string source;
  StreamConfig config;
  ReplayOptions stamps;
  bool paced = true;  ///< Wait for each frame's time; otherwise as fast as possible.
  std::size_t loops = 1;
  std::vector<SinkDescription> sinks{{SinkKind::jsonl, "-"}};
  std::optional<std::filesystem::path> stats;
};

/// What the command line asks for: work, or (--help, --version, --print-config) only a text on standard
/// output. Throws UsageError, and IoError for a folder that cannot
/// be listed.
std::variant<StreamOptions, std::string> parse_stream_options(int argc, const char* const* argv);

}  // namespace pcl_bv
