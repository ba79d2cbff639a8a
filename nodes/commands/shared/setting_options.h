// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The command-line options of the settings.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "command_line.h"
#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv::detail {

/// Returns a function that names settings by their options. A setting without an option has its key as its
/// name. The settings of tracks and queues have options only if `stream` is true.
SettingName option_names(bool stream);

/// The options that configure a command: --preset, --config, --print-config, the options for regions, and the
/// options of the settings (nodes/pipeline/config/settings.h). Options override the file, the file overrides
/// the preset, and the preset overrides the defaults.
class SettingOptions {
 public:
  /// Declares the options. If `stream` is true, also declares the options of tracks and queues. Stores a
  /// reference to `line`.
  SettingOptions(CommandLine& line, const StreamConfig& defaults, bool stream);

  /// Returns the configuration of the parsed command line. If `range_from` is not null, sets `*range_from`
  /// to where the range of distances comes from: "--range", "--config FILE", "--preset NAME" or "the default;
  /// see --range". Throws UsageError.
  StreamConfig config(std::string* range_from = nullptr) const;

  bool print_config() const { return print_config_; }
  const std::string& file() const { return file_; }  ///< File of --config; empty without it.

 private:
  void apply(StreamConfig& config) const;
  void reject_useless(const PipelineConfig& config) const;

  CommandLine& line_;
  const StreamConfig defaults_;
  /// Values by option. The command line refers to these values, which a map never moves.
  std::map<std::string_view, std::string> texts_;
  std::map<std::string_view, bool> flags_;
  std::string preset_, file_, padding_;
  std::vector<std::string> dropped_, cropped_;
  bool stream_, print_config_ = false;
};

}  // namespace pcl_bv::detail
