// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/points/isa.h"
#include "pipeline/deskew/point_times.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A cloud of a rig's sensor and the pose of that sensor in the frame of the rig.
struct MountedCloud {
  const Frame* frame = nullptr;  ///< Null if the sensor has no cloud for this frame.
  std::string name;              ///< Of the sensor.
  Pose pose = Pose::Identity();
};

/// Merges the clouds of several sensors into one. Each point is copied once, transformed. Reuses the memory
/// of released clouds.
class CloudMerger {
 public:
  /// If `times`, merged clouds have Frame::seconds. The instruction set does not change the result.
  explicit CloudMerger(bool times, UsableIsa isa = Isa::automatic) : times_(times), isa_(isa) {}

  /// Replaces the points of `merged`, their intensities, classes, times and sensors. Intensities and classes
  /// are set if all clouds have them. `merged.header.stamp_ns` must be set. O(points).
  void merge(const std::vector<MountedCloud>& clouds, Frame& merged);

  /// Returns the warnings since the last call, one line each. There is one for each sensor whose times of
  /// points are unusual (times_warning()). Without usable times, points get the stamp of their cloud.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

 private:
  struct Memory {
    std::vector<double> xyz;  // as float32 or float64
    std::vector<float> seconds, intensity;
    std::vector<std::int64_t> classes;
    bool has_intensity = false, has_classes = false;
  };
  // Memory of frames that have been processed, by any thread.
  struct Pool {
    std::mutex mutex;
    std::vector<std::unique_ptr<Memory>> unused;
  };

  std::shared_ptr<Memory> take_memory();
  void copy(const MountedCloud& cloud, const SensorPart& part, ScalarType scalar, Memory& memory);
  void warn_of_times(const MountedCloud& cloud, const DeskewTimes& times);
  void write_times(const MountedCloud& cloud, std::int64_t stamp_ns, float* seconds);

  bool times_;
  UsableIsa isa_;
  PointTimes point_times_;
  std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();
  std::vector<std::string> warnings_;
  std::set<std::string> warned_;  // names of sensors that a warning named
};

}  // namespace detail
}  // namespace pcl_bv
