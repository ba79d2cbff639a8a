// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The configuration file: a pipeline and how frames get to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "pcl_bv/nodes/pipeline_config.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What happens to a frame that finds the queue full.
enum class QueuePolicy : std::uint8_t {
  automatic,    ///< "auto": block where frames come as fast as they can be taken, else drop_oldest.
  drop_oldest,  ///< The one that waits longest makes room: what comes out is as fresh as can be.
  drop_newest,  ///< It is dropped itself.
  block         ///< Its sender waits: nothing is lost. For files.
};

/// What `automatic` means for frames that come at a pace of their own, or do not; others as they are.
QueuePolicy resolved(QueuePolicy policy, bool paced);

struct RunnerConfig {
  std::size_t queue = 1;  ///< Frames that may wait, at least 1.
  QueuePolicy policy = QueuePolicy::automatic;
  double max_age_ms = 0;  ///< Frames that have waited longer are dropped; 0: none are.
  double watchdog_s = 0;  ///< Say so if no frame comes for so long, seconds; 0: never.
};

struct StreamConfig {
  PipelineConfig pipeline;
  RunnerConfig runner;

  /// As PipelineConfig::validate().
  std::vector<std::string> validate() const;
};

/// A file that cannot be used. what() is one line: the file, the line in it, the key, what is wrong and what
/// is allowed.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads YAML with the names of the fields above as keys, nested by stage: `filter: {range_min: 0.5}`. Keys
/// that are not there have the values of `defaults`; null is "not given" where a value may be missing. Throws
/// ConfigError for a file that cannot be read, is no YAML, has an unknown key or a value that is not allowed.
StreamConfig read_stream_config(const std::filesystem::path& file, const StreamConfig& defaults = {});

/// The same from a text; `name` stands for the file in errors.
StreamConfig parse_stream_config(const std::string& text, const std::string& name,
                                 const StreamConfig& defaults = {});

/// The whole configuration as such a file, with its units; reads back as the same values. Regions of volumes
/// without a file cannot be written: theirs are empty names, which reading refuses.
std::string to_yaml(const StreamConfig& config);

}  // namespace pcl_bv
