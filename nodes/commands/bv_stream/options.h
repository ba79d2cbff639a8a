// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command line of bv_stream, which is checked completely before any frame is read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pcl_bv/nodes/frame_sink.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv::detail {

/// When the next frame is due.
enum class Rate : std::uint8_t {
  fixed,     ///< At ReplayOptions::rate_hz.
  recorded,  ///< According to the stamps.
  max,       ///< As soon as the queue has capacity.
  live       ///< When it arrives.
};

struct StreamOptions {
  std::vector<std::string> sources;  ///< Several only with config.rig.
  StreamConfig config;
  std::string range_from;  ///< Where the range was set, see SettingOptions::config().
  ReplayOptions replay;
  Rate rate = Rate::fixed;
  std::vector<SinkOptions> sinks;
  std::optional<std::filesystem::path> stats;
  double report_seconds = 0;  ///< Seconds between reports. 0: no reports.
};

/// Parses the command line and returns the options. For --help, --version and --print-config, returns a text
/// for standard output instead. Throws UsageError, and IoError for a folder that cannot be listed.
std::variant<StreamOptions, std::string> parse_stream_options(int argc, const char* const* argv);

}  // namespace pcl_bv::detail
