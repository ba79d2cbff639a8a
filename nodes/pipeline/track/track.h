// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One object that is followed, and what a sighting says about it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "motion_filter.h"
#include "motion_judge.h"
#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/report/report.h"
#include "pcl_bv/volumes/aabb.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// How a box differs from where and how large it was expected, along the sensor's axes, in metres.
struct Change {
  Eigen::Vector3d centre, size;
  /// The least move of both faces: what a part that came into view, or went out of it, leaves.
  Eigen::Vector3d shift;
};

struct Track {
  MotionFilter motion;  // in the fixed frame
  MotionJudge judge;
  // Faces of the box from the place, along the sensor's axes.
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
  Eigen::Vector3d expected = Eigen::Vector3d::Zero();  // the place in the sensor's frame
  Eigen::Vector3d before = Eigen::Vector3d::Zero();    // the place at the last frame, in the fixed frame
  double unseen = 0;                                   // seconds since the last sighting
  std::size_t seen = 0, missed = 0, hidden = 0, age = 0;
  double yaw = 0, yaw_variance = 1;
  bool alive = false, moving = false;
  std::optional<std::uint32_t> id;
  std::optional<std::size_t> split_from;  // slot of the track inside whose expected box this one began
  std::size_t seen_since_split = 0;       // sightings since then, or since it was last occluded

  void start(const Aabb& box, const Pose& sensor);
  void predict(double seconds);
  void expect(const Pose& sensor);
  /// Where it is in the sensor's frame if it stands, unless it is known to move. If standing tracks were
  /// expected where their velocities lead, an error of the sensor's velocity would become theirs and stay for
  /// good.
  Aabb standing_box(const Pose& sensor) const;
  Aabb expected_box() const { return {expected + low, expected + high}; }
  Change change_to(const Aabb& box) const;
  void correct(const Aabb& box, const Pose& sensor, double seconds);

  /// `apparent`: velocity that standing points have in the sensor's frame; with `fixed`, all is told there.
  TrackEntry entry(const Pose& sensor, bool fixed, const Eigen::Vector3d& apparent) const;

 private:
  void judge_motion(const Eigen::Vector3d& half, const Pose& sensor, double seconds);
};

/// How unlikely it is that the box is the track's: squared standard deviations, `gate` being four of them for
/// a track of which all is known.
double cost_of(const Track& track, const Aabb& box, double gate);

}  // namespace pcl_bv
