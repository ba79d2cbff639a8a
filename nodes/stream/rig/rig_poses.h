// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Poses of the sensors in the frame of a rig, and of that frame in the fixed frame.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_source.h"
#include "stream/sources/sources.h"
#include "transform_feed.h"
#include "transforms.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The transforms of a rig and where they come from.
class RigPoses {
 public:
  /// `known`: the transforms that are known from the beginning. Throws IoError if `options.poses` cannot be
  /// read.
  RigPoses(std::vector<std::unique_ptr<TransformFeed>> feeds, Transforms known, const RigConfig& rig,
           const ReplayOptions& options);

  /// Returns the pose in the frame of the rig of a sensor at the stamp of its cloud. `frame` is the frame id
  /// of the sensor; if empty, that of the cloud.
  FoundTransform of_sensor(const std::string& frame, const Frame& cloud);

  /// Returns the pose of the frame of the rig in the fixed frame, first from the file of poses. Without a
  /// fixed frame and a file, there is none. `recorded_ns` as for TransformFeed::read().
  FoundTransform of_rig(std::int64_t stamp_ns, std::int64_t recorded_ns);

  /// Returns the warnings since the last call, one line each.
  std::vector<std::string> take_warnings();

 private:
  void read_feeds(std::int64_t recorded_ns);

  std::string frame_, fixed_frame_;
  std::vector<std::unique_ptr<TransformFeed>> feeds_;
  Transforms transforms_;
  Poses file_;
  std::int64_t recorded_ns_ = 0;  // of the latest cloud that has one
};

}  // namespace detail
}  // namespace pcl_bv
