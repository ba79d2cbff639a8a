// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes of a track: a front that stays in front, and on request a turn and sizes that do not jitter.
#pragma once

#include <Eigen/Core>
#include <array>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/obb.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What is known of the object in this frame.
struct BoxSighting {
  Pose sensor = Pose::Identity();                      // in a fixed frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // over the ground, in the sensor's axes
  bool moving = false;
  bool merged = false;     // Tracker::Assignment::merged
  bool separated = false;  // Tracker::Assignment::separated
};

/// The boxes of one object by one method, in the sensor's frame. Boxes of methods that are not upright only
/// keep the names of their axes.
class BoxFilter {
 public:
  /// `upright`: whether axis 2 of every box is up, as Obb::upright() leaves it.
  explicit BoxFilter(bool upright = true) : upright_(upright) {}

  /// The same box, its axes named as those of the last one were, as seen in the fixed frame. Of a moving
  /// object, axis 0 comes to point where it goes: once that has been said two frames more often than
  /// anything else, older frames counting less. Empty boxes stay as they are.
  Obb face(const Obb& box, const BoxSighting& sighting);

  /// A box of a face() around all the points. With `smooth` its turn is the mean over time in the fixed
  /// frame, of angles modulo 90 degrees, so that it does not matter which side was taken for the longer one.
  /// With `grow` its length and width are the largest that were seen, approached slowly, since a cluster that
  /// is two objects for a frame is larger, too; what is not seen is added away from the sensor. A merged
  /// cluster changes neither the mean turn nor the sizes; a separated one starts the sizes anew. The third
  /// axis stays as it is. Every valid point is inside (Obb::contains()). Boxes that are empty or not upright
  /// stay as they are. O(points).
  Obb steady(const Obb& box, const PointView& points, const BoxSighting& sighting, bool smooth, bool grow);

 private:
  double smoothed_yaw(const Obb& box, const BoxSighting& sighting);
  double grown(std::size_t axis, double seen, bool merged);

  bool upright_;
  bool known_ = false;
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();  // in the fixed frame
  std::array<double, 4> said_{};                        // that the front is axis 0, 1, -0, -1
  double cosine_ = 0, sine_ = 0;                        // sums over time, of four times the yaw
  std::array<double, 2> sizes_{};
  std::size_t seen_ = 0;
};

}  // namespace pcl_bv
