// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The configuration of a stream, which is a pipeline and the queue in front of it. It can be read from and
// written to YAML.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "pcl_bv/nodes/pipeline_config.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What happens when a frame arrives and the queue is full.
enum class QueuePolicy : std::uint8_t {
  automatic,    ///< "auto" in files; resolved_policy() tells what it means.
  drop_oldest,  ///< The frame that has waited longest is dropped, so that results are recent.
  drop_newest,  ///< The new frame is dropped.
  block         ///< The sender waits, so that no frame is lost. For files.
};

/// Returns drop_oldest for `automatic` if frames come at given times (`paced`), and block if they come as
/// fast as they are taken. Returns other policies unchanged.
QueuePolicy resolved_policy(QueuePolicy policy, bool paced);

/// Settings of a StreamRunner.
struct RunnerConfig {
  std::size_t queue = 1;  ///< Frames that may wait, at least 1.
  QueuePolicy policy = QueuePolicy::automatic;
  double max_age_ms = 0;  ///< Frames that have waited longer are dropped. 0: no limit.
  double watchdog_s = 0;  ///< Report if no frame comes for this number of seconds. 0: never.
};

/// The complete configuration of a stream.
struct StreamConfig {
  PipelineConfig pipeline;
  RunnerConfig runner;

  /// Same as PipelineConfig::validate(), for the settings of the pipeline and the runner.
  std::vector<std::string> validate() const;
};

/// Thrown for an unusable configuration. what() is one line with the file, line number, key, problem and
/// allowed values.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a YAML file. The keys are the field names above, nested by stage, such as `filter: {range_min:
/// 0.5}`. Missing keys keep the values of `defaults`. For optional values, null means "not given". Throws
/// ConfigError if the file cannot be read, is not YAML, or has an unknown key or a value that is not allowed.
StreamConfig read_stream_config(const std::filesystem::path& file, const StreamConfig& defaults = {});

/// Same as read_stream_config(), but parses `text`. Errors use `name` as the file name.
StreamConfig parse_stream_config(const std::string& text, const std::string& name,
                                 const StreamConfig& defaults = {});

/// Returns the whole configuration as YAML, with units in comments. parse_stream_config() of this text gives
/// the same values, with one exception. A region that has volumes but no file is written with an empty file
/// name, which parse_stream_config() rejects.
std::string to_yaml(const StreamConfig& config);

}  // namespace pcl_bv
