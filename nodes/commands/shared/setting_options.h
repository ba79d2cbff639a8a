// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <map>
#include <string>
#include <vector>

#include "command_line.h"
#include "pcl_bv/nodes/stream_config.h"

namespace pcl_bv {

/// A text with the options of settings in place of their keys.
std::string with_options(std::string text);

/// The options by which commands are configured: --preset, --config, --range, --print-config and those of the
/// settings (nodes/settings.h). Later ones in this order win: the defaults, the preset, the file, the
/// options.
class SettingOptions {
 public:
  /// Declares them; `stream`: those of tracks and queues, too. Keeps the line.
  SettingOptions(CommandLine& line, const StreamConfig& defaults, bool stream);

  /// What the parsed line asks for. `range_from` becomes where the range of distances comes from: "--range",
  /// "--config FILE", "--preset NAME" or "the default; see --range". Throws UsageError.
  StreamConfig config(std::string* range_from = nullptr) const;

  bool print_config() const { return print_config_; }
  const std::string& file() const { return file_; }  ///< Of --config, empty without it.

 private:
  void apply(StreamConfig& config) const;
  void refuse_useless(const PipelineConfig& config) const;

  CommandLine& line_;
  const StreamConfig defaults_;
  std::map<std::string_view, std::string> texts_;  ///< By option; nodes do not move.
  std::map<std::string_view, bool> flags_;
  std::string preset_, file_, range_, padding_;
  std::vector<std::string> dropped_, cropped_;
  bool stream_, print_config_ = false;
};

}  // namespace pcl_bv
