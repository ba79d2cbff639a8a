// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Functions that open sources, and the poses and replays that several sources use.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "name_times.h"
#include "pcl_bv/nodes/frame_source.h"
#include "stream/rig/transforms.h"

namespace pcl_bv {
class RecordingReader;

namespace [[gnu::visibility("default")]] detail {

/// Poses from the file of ReplayOptions::poses.
class Poses {
 public:
  Poses() = default;

  /// Throws IoError, with the file and the line, for content that cannot be read. `frames` is the number of
  /// frames, if known. `frame_numbers` are the numbers in the names of the frames, if all have one. For poses
  /// by frame number, the constructor also throws IoError if `frames` is nullopt, or if there are not
  /// `frames` poses and not one for each of `frame_numbers`, counted from 0.
  Poses(const std::filesystem::path& file, std::optional<std::size_t> frames,
        std::vector<std::size_t> frame_numbers = {});

  /// Returns a line that says how frames and poses are matched if their numbers differ, otherwise nothing.
  const std::string& note() const { return note_; }

  /// Returns the pose of the frame with this number (KITTI) or this stamp (TUM), depending on the format of
  /// the file. Returns nullopt if the file has no such pose.
  std::optional<Pose> at(std::size_t number, std::int64_t stamp_ns) const;

 private:
  bool by_stamp_ = false;
  std::vector<StampedPose> poses_;    // sorted by stamp
  std::vector<std::size_t> numbers_;  // of the poses of frames; empty if they are 0, 1, 2, ...
  std::string note_;
};

/// Returns the stamp of a frame: `own_ns` with ReplayOptions::own_stamps, otherwise that of frame `number` at
/// ReplayOptions::rate_hz. The number of a frame is counted over all passes, that of its pose in one pass.
inline std::int64_t replay_stamp(const ReplayOptions& options, std::int64_t own_ns, std::uint64_t number) {
  return options.own_stamps ? own_ns : std::llround(1e9 * static_cast<double>(number) / options.rate_hz);
}

/// Creates a source of `length` frames, repeated options.loops times. `files` are the files of the frames, or
/// empty. `load` puts cloud number `index` and the owner of its points into the frame, or throws an
/// exception. `times` are the stamps if options.own_stamps is set.
std::unique_ptr<FrameSource> make_replay(std::size_t length, std::vector<std::filesystem::path> files,
                                         const ReplayOptions& options,
                                         std::function<void(std::size_t index, Frame&)> load,
                                         NameTimes times = {});

std::unique_ptr<FrameSource> open_dds(const std::string& name, const ReplayOptions& options);

/// Returns the source kinds for packets and recordings, or none in a build without the component `recording`.
std::vector<SourceKind> recording_kinds();

/// open_recording(), with errors that begin with the name of the file.
std::unique_ptr<RecordingReader> open_named_recording(const std::string& recording);

/// Returns the topics with clouds of a recording. Returns the sensors of a capture of packets
/// (sensors_in_capture()) if there are several, otherwise none. Throws as open_named_recording().
std::vector<std::string> recorded_cloud_topics(const std::string& recording);

/// Returns whether the file has the extension of a recording or capture: .bag, .mcap, .db3, .pcap, .pcapng.
bool has_recording_extension(const std::filesystem::path& file);

/// Checks a file with the extension of a recording or capture (has_recording_extension()). Throws IoError if
/// the file is missing, is empty, or does not begin as a recording or capture. Does nothing for other
/// extensions and for folders.
void check_recording_content(const std::filesystem::path& file);

}  // namespace detail
}  // namespace pcl_bv
