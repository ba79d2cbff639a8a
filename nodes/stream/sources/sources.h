// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What recordings share.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "name_times.h"
#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv {

/// The file of ReplayOptions::poses.
class Poses {
 public:
  Poses() = default;

  /// Throws IoError, naming the file and the line, for what it cannot read, and where frames are numbered and
  /// there are not as many as `frames`, or nobody knows how many.
  Poses(const std::filesystem::path& file, std::optional<std::size_t> frames);

  std::optional<Pose> at(std::size_t number, std::int64_t stamp_ns) const;

 private:
  bool by_stamp_ = false;
  std::vector<std::pair<std::int64_t, Pose>> poses_;  // stamps rise
};

/// `length` frames, of these files if there are any, again and again: `load` fills in the cloud of the one at
/// a place, and its owner, and throws if it cannot. `times` are the stamps where options.from_name asks for
/// them.
std::unique_ptr<FrameSource> make_replay(std::size_t length, std::vector<std::filesystem::path> files,
                                         const ReplayOptions& options,
                                         std::function<void(std::size_t place, Frame&)> load,
                                         NameTimes times = {});

std::unique_ptr<FrameSource> open_dds(const std::string& name, const ReplayOptions& options);

/// Packets and recordings; none in a build without recordings.
std::vector<SourceKind> recording_kinds();

/// Throws IoError for a file that is called a recording or a capture (.bag, .mcap, .db3, .pcap, .pcapng) and
/// does not begin as one, and if it is not there or empty. Other names pass.
void refuse_false_recording(const std::filesystem::path& file);

}  // namespace pcl_bv
