// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_result.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Detects results that a user should not trust:
/// - no ground, little ground or only ground;
/// - a cloud that does not surround its sensor or is upside down;
/// - many points far away;
/// - a sensor height that fits no plane;
/// - stamps of tracked frames that do not advance.
class FrameWarnings {
 public:
  /// Returns the warnings about a result, one line each. The lines name settings by their keys. Each kind of
  /// warning is returned once per configuration. `frame` is the frame of `result`; its points must be in
  /// memory if ground was removed.
  ///
  /// O(1), except for the search for another up direction, which takes milliseconds. It happens at most once
  /// for a frame without ground and once for a frame with little ground.
  std::vector<std::string> take(const Frame& frame, const FrameResult& result);

 private:
  std::shared_ptr<const PipelineConfig> config_;
  std::uint32_t returned_ = 0;  // kinds already returned, one bit each
  bool searched_ = false;       // whether little ground has led to a search for another up direction
};

}  // namespace pcl_bv
