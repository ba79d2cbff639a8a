// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/nodes/frame_source.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct RecordedTopic;

/// The place of the topic of this name, or, if it is empty, of the only one with sensor_msgs/msg/PointCloud2,
/// in CDR or ROS 1's encoding. Throws std::invalid_argument, listing those that would do, if the topic is not
/// there, has no clouds, or has to be named; IoError if no topic has clouds.
std::size_t cloud_topic(const std::vector<RecordedTopic>& topics, const std::string& name);

/// Whether there are clouds of a recording (open_recording()) or of a sensor's packets (VelodyneReader), by
/// the first bytes.
bool has_recorded_clouds(const std::filesystem::path& file);

/// The clouds of a recording or of a capture of packets, by their numbers. May be asked by several threads at
/// a time, one of which waits.
class RecordedClouds {
 public:
  /// `topic`: of packets the address of a sensor. Throws as open_recording() and cloud_topic(), or
  /// VelodyneReader, do.
  RecordedClouds(const std::filesystem::path& file, const std::string& topic);
  ~RecordedClouds();
  RecordedClouds(const RecordedClouds&) = delete;
  RecordedClouds& operator=(const RecordedClouds&) = delete;

  /// Without an index all of the file is read.
  std::size_t count();

  /// With all fields. In the order of the numbers, or nearly, each is read once: the last 16 clouds that were
  /// passed over are stored until they are loaded. Any other one before the last one requested means reading
  /// from the beginning. Throws IoError if it is not there, MessageError if it is no cloud.
  RawCloud load(std::size_t number);

  /// The note of a cloud that was loaded. Empty if the cloud before it has the same note, as all clouds of a
  /// driver do.
  std::string unsaid(std::size_t number) const;

  /// What was damaged so far, a line each.
  std::vector<std::string> remarks() const;

  /// Those of remarks() that were not taken before.
  std::vector<std::string> take_remarks();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The sweeps of a capture of packets as frames. Throws IoError, naming the file.
std::unique_ptr<FrameSource> open_packets(const std::string& name, const ReplayOptions& options);

}  // namespace pcl_bv
