// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One file for each of the sources that the table names.
#pragma once

#include "pcl_bv/nodes/frame_source.h"
#include "poses.h"

namespace pcl_bv {

inline constexpr std::string_view kSynth = "synth:";

std::unique_ptr<FrameSource> open_folder(const std::string& name, const ReplayOptions& options);
std::unique_ptr<FrameSource> open_synth(const std::string& name, const ReplayOptions& options);

inline double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// Where a recording is, and what its frames are called.
class Replay {
 public:
  /// Of `length` frames. Throws as open_source().
  Replay(std::size_t length, const ReplayOptions& options);

  bool ended() const { return seq_ == end_; }
  std::size_t place() const { return seq_ % length_; }  ///< Number in the recording.

  /// The frame at this place, without its cloud; goes on to the next one.
  Frame begin(std::string file, std::string_view frame_id);

 private:
  ReplayOptions options_;
  std::size_t length_;
  std::uint64_t end_, seq_ = 0;
  Poses poses_;
};

}  // namespace pcl_bv
