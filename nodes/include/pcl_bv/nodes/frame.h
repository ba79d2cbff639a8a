// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One cloud of a stream on its way in.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What names a frame; kept as it came.
struct FrameHeader {
  std::uint64_t seq = 0;      ///< Number in the stream, if the source counts: it may repeat or stay 0.
  std::int64_t stamp_ns = 0;  ///< When the sensor took it, nanoseconds of the sensor's clock.
  std::string frame_id;       ///< The coordinate frame of the points.
  std::uint64_t number = 0;   ///< Given by StreamRunner: 0, 1, 2, ... in the order in which frames came.
};

/// Where the sensor is: a point p in its frame is at pose * p in the fixed one. Converts from and to
/// Eigen::Isometry3d, whose alignment depends on a program's -mavx, which a library's types must not.
using Pose = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

/// A cloud of any point type.
struct Frame {
  FrameHeader header;
  PointView points;

  /// Keeps alive what `points` looks at. May be null only where the frame does not outlive the call, as in
  /// FramePipeline::process(); StreamRunner::push() refuses points without it.
  std::shared_ptr<const void> owner;

  double decode_ms = 0;  ///< What reading it cost, if somebody measured it.
  std::string file;      ///< Where it comes from; empty if not from a file.
  std::string note;      ///< What its source noticed and did not refuse, for people; mostly empty.
  /// The class of each point, by point number, where somebody has told them apart; else null.
  std::shared_ptr<const std::vector<std::int64_t>> classes;
  /// Of each point, by point number, for those who look at it; `owner` keeps it. Not given: the source knows
  /// none.
  std::optional<FieldView> intensity{};
  std::optional<Pose> pose;  ///< Of the sensor in a fixed frame, if it is known.
  /// Where the source says that the sensor is in the frame of the points, metres, as VIEWPOINT of a .pcd
  /// does.
  std::optional<Eigen::Vector3d> sensor{};
  /// When it was recorded or sent, nanoseconds of that machine's clock; 0: not known. For tracks whose stamps
  /// do not advance.
  std::int64_t recorded_ns = 0;

  /// From when its latency counts. Replays at a pace: when it was due. A live source whose stamps are the
  /// system's time: steady_time(stamp_ns). If not set, StreamRunner::push() sets it to when it is called.
  std::chrono::steady_clock::time_point taken{};
};

/// A sensor's position as clouds note it; nothing if it is the origin, which clouds without one have, or if a
/// coordinate is not finite or above kMaxCoordinate.
inline std::optional<Eigen::Vector3d> place_of_sensor(const Eigen::Vector3d& noted) {
  const bool is_place = (noted.array().abs() <= kMaxCoordinate).all() && !noted.isZero(0);  // false for NaN
  return is_place ? std::optional(noted) : std::nullopt;
}

/// The position that VIEWPOINT of a .pcd says, in the frame of the points, as place_of_sensor().
inline std::optional<Eigen::Vector3d> sensor_of(const RawCloud& cloud) {
  return place_of_sensor({cloud.viewpoint[0], cloud.viewpoint[1], cloud.viewpoint[2]});
}

/// A time of the system's clock, nanoseconds since 1970, on the clock that is never set.
inline std::chrono::steady_clock::time_point steady_time(std::int64_t system_ns) {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::steady_clock::now() - (since_1970 - std::chrono::nanoseconds(system_ns));
}

}  // namespace pcl_bv
