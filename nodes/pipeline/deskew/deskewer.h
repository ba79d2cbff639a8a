// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/kernels/deskew.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/parallel/execution.h"
#include "point_times.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Moves the points of each frame to where the sensor would have measured them at the frame's stamp.
class Deskewer {
 public:
  /// Moves the points of the frame, if their times and the motion of the sensor are known. `result.points`
  /// refers to memory of this object. O(points). A reused object allocates only if it needs more memory.
  void apply(const Frame& frame, const Execution& execution, DeskewResult& result);

  /// Stores the pose of the sensor in the last frame: Frame::pose if `from_source`, otherwise the tracker's.
  /// Call reset() after a frame without a pose.
  void remember(const Pose& pose, std::int64_t stamp_ns, bool from_source);

  /// Forgets all poses.
  void reset() {
    last_.reset();
    before_last_.reset();
  }

 private:
  struct Known {
    Pose pose;
    std::int64_t stamp_ns = 0;
    bool from_source = false;
  };

  std::optional<SensorMotion> motion_of(const Frame& frame) const;
  const float* read_times(const Frame& frame, UsableIsa isa, DeskewTimes& times);
  void move(const Frame& frame, const float* seconds, const SensorMotion& motion, const Execution& execution,
            DeskewResult& result);

  PointTimes point_times_;
  std::vector<float> seconds_;
  std::vector<double> xyz_;  // of all points, as float32 or float64
  std::optional<Known> last_, before_last_;
};

}  // namespace detail
}  // namespace pcl_bv
