// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The state of one tracked object, its update, and the cost of assigning a box to it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "known_object.h"
#include "motion_classifier.h"
#include "motion_filter.h"
#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/volumes/aabb.h"
#include "viewpoints.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Difference between a box and the expected box of a track, along the sensor's axes, metres.
struct BoxDifference {
  Eigen::Vector3d low, high;  ///< Displacements of the lower and upper faces.
  /// How far the box is outside the stored extents of the track. 0 if it is outside on both sides.
  Eigen::Vector3d outside;
  Eigen::Vector3d unseen;  ///< Size of the stored extents minus the size of the box.

  double centre(int axis) const { return (low[axis] + high[axis]) / 2; }
  double size(int axis) const { return high[axis] - low[axis]; }
  double shift(int axis) const;  ///< face_shift()
};

/// One tracked object.
struct Track {
  MotionFilter motion;  // in the fixed frame
  MotionClassifier motion_classifier;
  // Lower and upper faces of the box relative to the tracked position, along the sensor's axes.
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
  // The same faces of all parts of the object that have been seen (follow_faces()).
  Eigen::Vector3d full_low = Eigen::Vector3d::Zero(), full_high = Eigen::Vector3d::Zero();
  // The same faces of the last measured box.
  Eigen::Vector3d seen_low = Eigen::Vector3d::Zero(), seen_high = Eigen::Vector3d::Zero();
  Eigen::Vector3d expected_position = Eigen::Vector3d::Zero();  // in the sensor's frame
  Eigen::Vector3d previous_position = Eigen::Vector3d::Zero();  // in the fixed frame, one frame earlier
  double seconds_unseen = 0;                                    // since the last detection
  std::size_t detections = 0, age = 0;                          // age: in frames
  std::size_t missed = 0, occluded = 0;  // missed and occluded frames since the last detection
  double yaw = 0, yaw_variance = 1;
  bool active = false, moving = false;
  // Slot of the track in whose box this one disappeared, and whether that box was as large before: then this
  // track was of a part of that object. Until the next detection.
  std::optional<std::size_t> inside_of;
  bool is_part = false;
  std::optional<std::uint32_t> id;
  // Slot of the track whose expected box contained the centre of this track's first box.
  std::optional<std::size_t> split_from;
  std::size_t detections_since_split = 0;  // detections since the split or the last occlusion
  KnownObject known;                       // kept by Tracker::know()

  void start(const Aabb& box, const Pose& sensor);
  void predict(double seconds);
  void expect(const Pose& sensor);
  /// Returns the box, in the sensor's frame, that EgoMotion expects. A moving object is at its predicted
  /// position, any other object at its previous position. If static objects were at their predicted
  /// positions, an error of the estimated sensor velocity would pass into their velocities and stay there.
  Aabb static_box(const Pose& sensor) const;
  Aabb expected_box() const { return {expected_position + low, expected_position + high}; }
  /// The expected box of all parts of the object that have been seen.
  Aabb whole_box() const { return {expected_position + full_low, expected_position + full_high}; }
  BoxDifference difference_to(const Aabb& box) const;
  /// Whether the stored extents have the size of a vehicle, of which only a part may be in view.
  bool has_vehicle_size() const;
  void correct(const Aabb& box, const Pose& sensor, double seconds,
               const Viewpoints& viewpoints = Viewpoints::single());

  /// Returns the reported state. `apparent_velocity` is the velocity of static points in the sensor's frame.
  /// If `fixed` is true, the state is in the fixed frame, otherwise in the sensor's frame.
  TrackEntry entry(const Pose& sensor, bool fixed, const Eigen::Vector3d& apparent_velocity) const;

 private:
  void measure(const BoxDifference& difference, const Pose& sensor, const Viewpoints& viewpoints,
               const Aabb& box, double passed);
  void resize(const Aabb& box, const Pose& sensor);
  void slow_down();
  void classify_motion(const Eigen::Vector3d& half, const Pose& sensor, double seconds);
};

/// Returns how unlikely it is that the box belongs to the track, in squared standard deviations. For a track
/// whose state is known exactly, `gate` metres are about four standard deviations.
double cost_of(const Track& track, const Aabb& box, double gate);

}  // namespace detail
}  // namespace pcl_bv
