// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct RecordedTopic;

/// The place of the topic of this name, or, if it is empty, of the only one with sensor_msgs/msg/PointCloud2, in CDR
/// or ROS 1's encoding. Throws std::invalid_argument, listing those that would do, if the topic is not there, has no
/// clouds, or has to be named; IoError if no topic has clouds.
std::size_t cloud_topic(const std::vector<RecordedTopic>& topics, const std::string& name);

/// The clouds of a recording, by their numbers. May be asked by several threads at a time, one of which waits.
class RecordedClouds {
 public:
  /// Throws as open_recording() and cloud_topic() do.
  RecordedClouds(const std::filesystem::path& file, const std::string& topic);
  ~RecordedClouds();
  RecordedClouds(const RecordedClouds&) = delete;
  RecordedClouds& operator=(const RecordedClouds&) = delete;

  /// Without an index all of the file is read.
  std::size_t count();

  /// With all fields. In the order of the numbers each is read once; one before the last one asked for means
  /// reading from the beginning. Throws IoError if it is not there, MessageError if it is no cloud.
  RawCloud load(std::size_t number);

  /// What was damaged so far, a line each.
  std::vector<std::string> remarks() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_bv
