// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How well the motion and the boxes of tracks are known, where the truth is.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace pcl_bv::bench {

/// A track that matches an object, beside the truth. Velocities are in the fixed frame, m/s.
struct MotionSighting {
  std::uint32_t object = 0, track = 0;
  Eigen::Vector3d velocity, true_velocity;
  bool moving = false;
  double range = 0;  ///< Metres.
  /// Angle from the object's forward axis to the box's first one, radians, and the box's size along it,
  /// metres; of objects that have a front.
  std::optional<double> turn;
  double length = 0;
};

class MotionScore {
 public:
  static constexpr double moves = 0.5;  ///< m/s from which on an object moves
  static constexpr double near = 15;    ///< metres within which standing boxes are looked at

  void start_sequence() { ++sequence_; }
  void add(const MotionSighting& sighting);

  std::size_t sightings() const { return errors_.size(); }

  /// Of the horizontal errors of velocity, m/s; `share` from 0 to 1.
  double velocity_error(double share) const;

  /// The shares of standing and of moving objects of which it is said; 1 without any.
  double standing_right() const { return right_[0] / std::max(1.0, asked_[0]); }
  double moving_right() const { return right_[1] / std::max(1.0, asked_[1]); }
  double right() const { return (right_[0] + right_[1]) / std::max(1.0, asked_[0] + asked_[1]); }

  /// Boxes of a track whose first axis turned by more than 135 degrees against the object since the last one.
  std::size_t flips() const { return flips_; }
  std::size_t boxes() const { return boxes_; }

  /// Of standing objects with a front nearer than `near`: how far turns, modulo 180 degrees (in degrees), and
  /// lengths (in metres) are from the median of their track.
  double turn_jitter(double share) const;
  double length_jitter(double share) const;

 private:
  using Key = std::pair<std::size_t, std::pair<std::uint32_t, std::uint32_t>>;

  std::size_t sequence_ = 0, flips_ = 0, boxes_ = 0;
  double right_[2]{}, asked_[2]{};
  std::vector<double> errors_;
  std::map<Key, double> last_turn_;
  std::map<Key, std::vector<double>> turns_, lengths_;
};

}  // namespace pcl_bv::bench
