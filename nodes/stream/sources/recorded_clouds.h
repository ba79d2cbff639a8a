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

/// Returns the index of the topic with this name or, if `name` is empty, of the only topic with clouds
/// (sensor_msgs/msg/PointCloud2 in CDR or ROS 1 encoding). Throws std::invalid_argument, which lists the
/// topics with clouds, if the named topic does not exist or has no clouds, or if no name is given and several
/// topics have clouds. Throws IoError if no name is given and no topic has clouds.
std::size_t cloud_topic(const std::vector<RecordedTopic>& topics, const std::string& name);

/// Returns whether the file is a recording (open_recording()) or a capture of a sensor's packets
/// (VelodyneReader), by its first bytes.
bool has_recorded_clouds(const std::filesystem::path& file);

/// The clouds of a recording or of a packet capture, accessed by number. Several threads may call it; one at
/// a time proceeds.
class RecordedClouds {
 public:
  /// `topic` is the topic of a recording, or the ADDRESS:PORT of a sensor in a packet capture. Throws as
  /// open_recording() and cloud_topic(), or as VelodyneReader.
  RecordedClouds(const std::filesystem::path& file, const std::string& topic);
  ~RecordedClouds();
  RecordedClouds(const RecordedClouds&) = delete;
  RecordedClouds& operator=(const RecordedClouds&) = delete;

  /// Returns the number of clouds. Reads the whole file if it has no index.
  std::size_t count();

  /// Loads a cloud with all its fields. If clouds are loaded in ascending order, or nearly so, the file is
  /// read once: the last 16 skipped clouds are stored until they are loaded. Loading any other earlier cloud
  /// reads the file again from the beginning. Throws IoError if there is no such cloud, and MessageError if
  /// the message is not a cloud.
  RawCloud load(std::size_t number);

  /// Returns the note of a loaded cloud. Empty if the cloud before it has the same note, which is usual for
  /// the clouds of one driver.
  std::string new_note(std::size_t number) const;

  /// Returns a line for each damage found so far.
  std::vector<std::string> warnings() const;

  /// Returns the lines of warnings() that no earlier call has returned.
  std::vector<std::string> take_warnings();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The sweeps of a capture of packets as frames. Throws IoError, naming the file.
std::unique_ptr<FrameSource> open_packets(const std::string& name, const ReplayOptions& options);

}  // namespace pcl_bv
