// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The configuration of a stream: a pipeline and the queue in front of it. Read from and written to YAML.
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
  automatic,    ///< "auto": `block` if frames come as fast as they can be taken, else `drop_oldest`.
  drop_oldest,  ///< The frame that has waited longest is dropped: results are as recent as possible.
  drop_newest,  ///< The new frame is dropped.
  block         ///< The sender waits: no frame is lost. For files.
};

/// Returns what `automatic` means: drop_oldest if frames come at a pace of their own (`paced`), else block.
/// Returns other policies unchanged.
QueuePolicy resolved_policy(QueuePolicy policy, bool paced);

/// Settings of a StreamRunner.
struct RunnerConfig {
  std::size_t queue = 1;  ///< Frames that may wait, at least 1.
  QueuePolicy policy = QueuePolicy::automatic;
  double max_age_ms = 0;  ///< Frames that have waited longer are dropped; 0: none.
  double watchdog_s = 0;  ///< Report if no frame comes for so many seconds; 0: never.
};

/// The complete configuration of a stream.
struct StreamConfig {
  PipelineConfig pipeline;
  RunnerConfig runner;

  /// As PipelineConfig::validate().
  std::vector<std::string> validate() const;
};

/// Thrown for an unusable configuration. what() is one line: file, line number, key, problem and allowed
/// values.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a YAML file. The keys are the field names above, nested by stage: `filter: {range_min: 0.5}`.
/// Missing keys keep the values of `defaults`; null means "not given" for optional values. Throws ConfigError
/// if the file cannot be read, is not YAML, or has an unknown key or a value that is not allowed.
StreamConfig read_stream_config(const std::filesystem::path& file, const StreamConfig& defaults = {});

/// As read_stream_config(), from a text. Errors use `name` as the file name.
StreamConfig parse_stream_config(const std::string& text, const std::string& name,
                                 const StreamConfig& defaults = {});

/// Returns the whole configuration as YAML, with units in comments. Reading the text gives the same values,
/// with one exception: regions whose volumes have no file are written with an empty file name, which reading
/// rejects.
std::string to_yaml(const StreamConfig& config);

}  // namespace pcl_bv
