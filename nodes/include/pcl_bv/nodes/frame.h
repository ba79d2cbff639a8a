// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A frame: one point cloud of a stream.
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

/// Identifies a frame. The result of a frame has the same header.
struct FrameHeader {
  std::uint64_t seq = 0;      ///< Number given by the source; it may repeat or stay 0.
  std::int64_t stamp_ns = 0;  ///< Time of the measurement, nanoseconds of the sensor's clock.
  std::string frame_id;       ///< Coordinate frame of the points.
  std::uint64_t number = 0;   ///< Given by StreamRunner: 0, 1, 2, ... in the order of arrival.
};

/// Pose of the sensor. A point p in the sensor's frame is at pose * p in the fixed frame. Pose can be
/// converted from and to Eigen::Isometry3d. The alignment of Eigen::Isometry3d depends on the compiler option
/// -mavx, but the types of a library's interface must not depend on compiler options. Therefore Pose is
/// unaligned.
using Pose = Eigen::Transform<double, 3, Eigen::Isometry, Eigen::DontAlign>;

/// The part of a merged cloud that one sensor of a rig measured (open_rig()).
struct SensorPart {
  std::string name;           ///< Topic or source of the sensor.
  std::size_t first = 0;      ///< Index of its first point in the merged cloud.
  std::size_t count = 0;      ///< Number of its points; 0 if the sensor sent no cloud for this frame.
  std::int64_t stamp_ns = 0;  ///< Stamp of its cloud.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< Of the sensor in the frame of the points, metres.
                                                       ///< Without a cloud: the last one.
};

/// A cloud of any point type with its header.
struct Frame {
  FrameHeader header;
  PointView points;

  /// Keeps the memory of `points` alive. May be null only if the points are used during a call and not
  /// afterwards, as in FramePipeline::process(). StreamRunner::push() rejects points without an owner.
  std::shared_ptr<const void> owner;

  double decode_ms = 0;  ///< Time of reading and decoding, if measured.
  std::string file;      ///< File or source of the frame; may be empty.
  std::string note;      ///< Warning of the source about this frame; usually empty.
  /// Class of each point, by point number; null if points have no classes.
  std::shared_ptr<const std::vector<std::int64_t>> classes;
  /// Intensity of each point, by point number, to be displayed. `owner` keeps the memory of the intensities
  /// alive. Not set if the source has no intensities.
  std::optional<FieldView> intensity{};
  /// Time at which each point was measured, by point number, in any unit (PipelineConfig::deskew). `owner`
  /// keeps the memory of the times alive. Not set if the source has no times.
  std::optional<FieldView> times{};
  /// Same as `times`, but in seconds after the stamp, one for each point. Used instead of `times` if not
  /// null.
  const float* seconds = nullptr;
  std::optional<Pose> pose;   ///< Of the frame of the points (a sensor or a rig) in a fixed frame, if known.
  std::string fixed_frame{};  ///< Name of that fixed frame, if known.
  /// Sensor position in the frame of the points, metres. Set if the source has the position, for example as
  /// VIEWPOINT of a .pcd file.
  std::optional<Eigen::Vector3d> sensor{};
  /// Position that had the coordinates 0, 0, 0 before the points were moved, for example by pcd_bv's
  /// --origin; in the frame of the points, metres. Ranges and growing tolerances are measured from here. The
  /// sensor is assumed here if neither `sensor` nor `sensors` is set.
  Eigen::Vector3d recorded_origin = Eigen::Vector3d::Zero();
  /// The sensors of a merged cloud, in the order of their points. Empty for the cloud of a single sensor.
  std::vector<SensorPart> sensors{};
  /// Time of recording or sending, nanoseconds of the clock of the recording or sending machine. 0: unknown.
  /// Tracking uses this time if the stamps do not advance.
  std::int64_t recorded_ns = 0;
  /// Number of the pass over a source that is repeated (ReplayOptions::loops). Tracks end with a pass.
  std::uint64_t pass = 0;
  /// What was added to the stamp of the source, nanoseconds (--loop). Absolute times of points lack it.
  std::int64_t stamp_shift_ns = 0;

  /// Time from which the latency of the frame is measured. A paced replay sets `taken` to the time at which
  /// the frame is due. A live source sets `taken` to the arrival of the message, or to steady_time(stamp_ns)
  /// if stamps are times of the system clock. If `taken` is unset, StreamRunner::push() sets it to the time
  /// of the call.
  std::chrono::steady_clock::time_point taken{};
};

/// Returns `noted`, the sensor position that a cloud stores, if the position is usable. Returns nullopt for
/// the origin, because clouds without a position store the origin. Also returns nullopt if a coordinate is
/// not finite or exceeds kMaxCoordinate in magnitude.
inline std::optional<Eigen::Vector3d> stored_sensor_position(const Eigen::Vector3d& noted) {
  // False for NaN.
  const bool is_position = (noted.array().abs() <= kMaxCoordinate).all() && !noted.isZero(0);
  return is_position ? std::optional(noted) : std::nullopt;
}

/// Returns the sensor position in VIEWPOINT of a .pcd file, in the frame of the points. Returns nullopt if
/// the position is not usable (stored_sensor_position()).
inline std::optional<Eigen::Vector3d> sensor_of(const RawCloud& cloud) {
  return stored_sensor_position({cloud.viewpoint[0], cloud.viewpoint[1], cloud.viewpoint[2]});
}

/// Converts a time of the system clock, in nanoseconds since 1970, to a time of the steady clock. Nobody can
/// set the steady clock.
inline std::chrono::steady_clock::time_point steady_time(std::int64_t system_ns) {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::steady_clock::now() - (since_1970 - std::chrono::nanoseconds(system_ns));
}

}  // namespace pcl_bv
