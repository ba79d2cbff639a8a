// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whether an object moves, by how far its box has gone within the last half second.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A velocity of one frame is too noisy for this: a box of which other parts are seen jumps by decimetres, in
/// a tenth of a second faster than a walker. Over half a second a walker leaves his place, and in both halves
/// of it the same way, while one face of what stands stays where it was, or its parts jump to and fro.
class MotionJudge {
 public:
  /// A sighting, `seconds` after the last one: the box's centre in the fixed frame, half its size along the
  /// sensor's axes, whose turn into the fixed frame is `turn`. Metres.
  void add(const Eigen::Vector3d& centre, const Eigen::Vector3d& half, const Eigen::Matrix3d& turn,
           double seconds);

  bool moving() const { return moving_; }

 private:
  struct Sighting {
    double seconds = 0;  // since the first one
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(), half = Eigen::Vector3d::Zero();
  };
  static constexpr std::size_t kMost = 8;

  const Sighting& past(std::size_t i) const { return past_[(first_ + i) % kMost]; }
  void judge(const Sighting& now, const Eigen::Matrix3d& turn);

  std::array<Sighting, kMost> past_;  // a ring
  std::size_t first_ = 0, count_ = 0;
  double seconds_ = 0;
  bool moving_ = false;
};

}  // namespace pcl_bv
