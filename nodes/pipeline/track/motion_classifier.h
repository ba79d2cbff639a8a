// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Decides whether an object moves, by the displacement of its box within the last half second.
///
/// The velocity of one frame is too noisy for this decision. If another part of an object becomes visible,
/// its box jumps by decimetres within 0.1 s, which is faster than a pedestrian walks. Within half a second,
/// the whole box of a pedestrian moves, in the same direction in both halves of this time. If the object is
/// static, one face of its box stays in place, or the box jumps back and forth.
class MotionClassifier {
 public:
  /// Adds a measurement, `seconds` after the last one. `centre` is the centre of the box in the fixed frame.
  /// `half` is half the size of the box along the sensor's axes. Lengths are in metres. `rotation` maps
  /// vectors along the sensor's axes to the fixed frame.
  void add(const Eigen::Vector3d& centre, const Eigen::Vector3d& half, const Eigen::Matrix3d& rotation,
           double seconds);

  bool moving() const { return moving_; }
  /// Whether there have been enough measurements for a decision. Before, moving() is false.
  bool decided() const { return decided_; }

 private:
  struct Measurement {
    double seconds = 0;  // since the first measurement
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(), half = Eigen::Vector3d::Zero();
  };
  static constexpr std::size_t kCapacity = 8;

  const Measurement& past(std::size_t i) const { return past_[(first_ + i) % kCapacity]; }
  void classify(const Measurement& now, const Eigen::Matrix3d& rotation);

  std::array<Measurement, kCapacity> past_;  // ring buffer
  std::size_t first_ = 0, count_ = 0;
  double seconds_ = 0;
  bool moving_ = false, decided_ = false;
};

}  // namespace detail
}  // namespace pcl_bv
