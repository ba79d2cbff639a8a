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

namespace pcl_bv {
class RecordingReader;

namespace [[gnu::visibility("default")]] detail {

/// Returns the index of the topic with this name. If `name` is empty, returns the index of the only topic
/// with clouds (cloud_type_of(), in CDR or ROS 1 encoding).
///
/// Throws std::invalid_argument if the named topic does not exist or has no clouds, or if `name` is empty and
/// several topics have clouds. The message lists the topics that have clouds. Throws IoError if `name` is
/// empty and no topic has clouds, or if damage of the recording leaves no topic.
std::size_t cloud_topic(const RecordingReader& reader, const std::string& name);

/// Returns whether the file's first bytes are those of a recording (open_recording()) or of a capture of a
/// sensor's packets (PacketReader).
bool has_recorded_clouds(const std::filesystem::path& file);

/// The clouds of a recording or of a packet capture, accessed by number. Several threads may call the member
/// functions, which run one at a time.
class RecordedClouds {
 public:
  /// `topic` is the topic of a recording, or the ADDRESS:PORT of a sensor in a packet capture. Throws as
  /// open_recording() and cloud_topic(), or as PacketReader.
  RecordedClouds(const std::filesystem::path& file, const std::string& topic);
  ~RecordedClouds();
  RecordedClouds(const RecordedClouds&) = delete;
  RecordedClouds& operator=(const RecordedClouds&) = delete;

  /// Returns the number of clouds. Reads the whole file if the file has no index.
  std::size_t count();

  /// Loads a cloud with all its fields. If clouds are loaded in ascending order, or nearly so, the file is
  /// read once, because the last 16 skipped clouds are stored until they are loaded. Loading any other
  /// earlier cloud reads the file again from the beginning.
  ///
  /// Throws IoError if there is no cloud with this number, and MessageError if the message is not a cloud.
  RawCloud load(std::size_t number);

  /// Returns the note of a loaded cloud. If the cloud that was read before it has the same note, as is usual
  /// for the clouds of one driver, returns an empty text.
  std::string new_note(std::size_t number) const;

  /// Returns a line for each damage of the file that has been found so far.
  std::vector<std::string> warnings() const;

  /// Returns the lines of warnings() that no earlier call has returned.
  std::vector<std::string> take_warnings();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the warnings after the first `taken` ones, and adds their number to `taken`.
std::vector<std::string> take_new(const std::vector<std::string>& warnings, std::size_t& taken);

/// Returns a source of the sweeps in a capture of packets. Throws as PacketReader; the text of an IoError
/// begins with the name of the file.
std::unique_ptr<FrameSource> open_packets(const std::string& name, const ReplayOptions& options);

}  // namespace detail
}  // namespace pcl_bv
