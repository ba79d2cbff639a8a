// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Filters the boxes of a track. The axes keep their order and directions from frame to frame. On request, yaw
// and sizes are smoothed.
#pragma once

#include <Eigen/Core>
#include <array>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/obb.h"
#include "vehicle_extent.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// The state of the object in this frame.
struct BoxState {
  Pose sensor = Pose::Identity();                      // pose in a fixed frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // over the ground, along the sensor's axes, m/s
  bool moving = false;
  bool merged = false;           // Tracker::Assignment::merged
  bool separated = false;        // Tracker::Assignment::separated
  Surroundings around{};         // what may occlude parts of the object
  bool extends_vehicles = true;  // TrackConfig::vehicles
};

/// Filters the boxes of one object by one method, in the sensor's frame. If the method is not upright, only
/// the order and directions of the axes are kept consistent.
class BoxFilter {
 public:
  /// `upright` tells whether axis 2 of every box points up, as in boxes of Obb::upright().
  explicit BoxFilter(bool upright = true) : upright_(upright) {}

  /// Returns the same box with its axes in the order and directions of the last box, compared in the fixed
  /// frame. Empty boxes are returned unchanged.
  ///
  /// Axis 0 of a moving object turns to the direction of motion. The candidates are the directions of axis 0
  /// and axis 1 and the two opposite directions. In each frame, the candidate nearest to the velocity gets a
  /// vote. Older votes decay. A candidate with over two votes more than axis 0 becomes axis 0.
  Obb align_axes(const Obb& box, const BoxState& state);

  /// Returns a smoothed box around all points; `box` must come from align_axes().
  ///
  /// If `smooth` is true, the yaw is the mean over time in the fixed frame. Angles are averaged modulo 90
  /// degrees, so it does not matter which side of the object was measured as the longer one. From 2 m/s on,
  /// the direction of motion has the same weight as the measured yaw.
  ///
  /// If `grow` is true, the filter stores a length and a width that approach the largest measured ones. In
  /// the first five detections, the stored sizes grow without a limit. Later they grow by at most 0.15 m per
  /// frame, because a cluster that contains two objects in one frame is larger than the object. The box gets
  /// the stored or the measured size, whichever is larger, and what may be a vehicle gets the size of a small
  /// car (extend_vehicle()). The box is extended on the side away from the sensors, or on both sides if it is
  /// between them.
  ///
  /// A merged cluster changes neither the mean yaw nor the stored sizes. A separated cluster restarts the
  /// stored sizes.
  ///
  /// Axis 2 is unchanged. Every valid point is inside the returned box (Obb::contains()). Boxes that
  /// are empty or not upright are returned unchanged. O(points).
  Obb smoothed(const Obb& box, const PointView& points, const BoxState& state, bool smooth, bool grow);

 private:
  double smoothed_yaw(const Obb& box, const BoxState& state);
  double grown_size(std::size_t axis, double seen, bool merged);

  bool upright_;
  bool known_ = false;
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // axes of the last box, in the fixed frame
  std::array<double, 4> votes_{};                       // for axis 0, axis 1, opposite of 0, opposite of 1
  double cosine_ = 0, sine_ = 0;                        // decaying sums of the cosine and sine of 4 * yaw
  std::array<double, 2> sizes_{};
  std::size_t detections_ = 0;
};

}  // namespace detail
}  // namespace pcl_bv
