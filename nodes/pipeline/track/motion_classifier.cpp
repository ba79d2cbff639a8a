// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion_classifier.h"

#include <algorithm>
#include <cmath>

#include "face_shift.h"

namespace pcl_bv::detail {
namespace {

constexpr double kWindow = 0.55;   // seconds; length of the evaluated window
constexpr double kSpacing = 0.09;  // seconds between stored measurements
constexpr double kMinTime = 0.15;  // seconds; shortest time that allows a decision
// A moving object is displaced by at least kMinShift metres and by this share of its length. Faces that come
// into view displace the box of a long object farther. Without the share, 1 % more of the static objects are
// classified as moving.
constexpr double kMinShift = 0.3, kMinShiftShare = 0.2;
// An object starts to move above kStartSpeed + kStartSpeedPerMetre * length, and is static again below
// kStopSpeed, m/s.
constexpr double kStartSpeed = 0.7, kStartSpeedPerMetre = 0.2, kStopSpeed = 0.5;
// The velocities in the two halves of the window have the same direction if their dot product, divided by the
// larger squared velocity, is above this value.
constexpr double kMinAlignment = 0.25;

// Returns face_shift() along the sensor's x and y.
Eigen::Vector2d smallest_shift(const Eigen::Vector3d& displacement, const Eigen::Vector3d& before,
                               const Eigen::Vector3d& now) {
  Eigen::Vector2d shift;
  for (int i = 0; i < 2; ++i)
    shift[i] = face_shift(displacement[i] - now[i] + before[i], displacement[i] + now[i] - before[i]);
  return shift;
}

}  // namespace

void MotionClassifier::add(const Eigen::Vector3d& centre, const Eigen::Vector3d& half,
                           const Eigen::Matrix3d& rotation, double seconds) {
  seconds_ += seconds;
  const Measurement now{seconds_, centre, half};
  for (; count_ > 1 && past(1).seconds <= seconds_ - kWindow; --count_)
    first_ = (first_ + 1) % kCapacity;
  if (count_ > 1 && seconds_ - past(0).seconds >= kMinTime) classify(now, rotation);
  if (count_ < kCapacity && (count_ == 0 || seconds_ - past(count_ - 1).seconds >= kSpacing))
    past_[(first_ + count_++) % kCapacity] = now;
}

void MotionClassifier::classify(const Measurement& now, const Eigen::Matrix3d& rotation) {
  const auto shift = [&](const Measurement& from, const Measurement& to) {
    return smallest_shift(rotation.transpose() * (to.centre - from.centre), from.half, to.half);
  };
  const Measurement &oldest = past(0), &middle = past(count_ / 2);
  const double passed = now.seconds - oldest.seconds, displacement = shift(oldest, now).norm();
  if (moving_) {
    moving_ = displacement >= kStopSpeed * std::max(passed, kWindow);
    return;
  }
  if (!(now.seconds > middle.seconds)) return;
  decided_ = true;
  const Eigen::Vector2d first = shift(oldest, middle) / (middle.seconds - oldest.seconds),
                        second = shift(middle, now) / (now.seconds - middle.seconds);
  const bool same_direction =
      first.dot(second) > kMinAlignment * std::max(first.squaredNorm(), second.squaredNorm());
  const double length = 2 * now.half.head<2>().maxCoeff();
  moving_ = same_direction && displacement > std::max(kMinShift, kMinShiftShare * length) &&
            displacement > (kStartSpeed + kStartSpeedPerMetre * length) * passed;
}

}  // namespace pcl_bv::detail
