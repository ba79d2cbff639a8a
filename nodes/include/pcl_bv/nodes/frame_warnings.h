// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_result.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What a user wants to know before believing results: no ground or nothing else, a cloud that does not lie
/// around its sensor's place or is upside down, a sensor height that fits no plane, stamps of tracked frames
/// that do not advance.
class FrameWarnings {
 public:
  /// Returns those that were not yet returned under the result's configuration: of a stream each kind comes
  /// once. They name settings by their keys. `frame` is that of the result, whose points are in memory if
  /// ground was removed. O(1), except where another up direction is searched: that takes milliseconds, and
  /// happens once for the first frame without ground and once for the first with little.
  std::vector<std::string> take(const Frame& frame, const FrameResult& result);

 private:
  std::shared_ptr<const PipelineConfig> config_;
  std::uint32_t said_ = 0;  // bits of kinds
  bool searched_ = false;   // another up direction, in a frame with little ground
};

}  // namespace pcl_bv
