// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "track.h"

#include <algorithm>
#include <cmath>

namespace pcl_bv {
namespace {

constexpr double kFaceVariance = 0.1 * 0.1;  // m^2; variance of a measured face
constexpr double kFirstSpeed = 8;             // m/s; standard deviation of an unknown velocity
constexpr double kManoeuvre = 0.3;            // m^2/s^3; noise of the acceleration: 1.7 m/s^2 for 0.1 s
constexpr double kTurnNoise = 0.1;              // 1/s; the same per squared speed: 57 degrees/s for 0.1 s
constexpr double kMaxSpeed = 60;               // m/s; limit of the speed
constexpr double kMinStep = 0.03;            // seconds; smallest step that gives a first velocity

// Returns the variances along the axes after a rotation: the diagonal of R diag(v) R^T.
Eigen::Vector3d turned(const Eigen::Matrix3d& turn, const Eigen::Vector3d& variances) {
  return turn.cwiseAbs2() * variances;
}

// Returns the innovation: the shift of the centre if the size is unchanged, the smallest shift of the faces
// if the size changes by 0.25 m or more, and a blend between.
double innovation_of(const Change& change, int axis) {
  const double part = std::clamp((std::abs(change.size[axis]) - 0.05) / 0.2, 0.0, 1.0);
  return (1 - part) * change.centre[axis] + part * change.shift[axis];
}

}  // namespace

void Track::start(const Aabb& box, const Pose& sensor) {
  *this = Track();
  const Eigen::Vector3d half = (box.max() - box.min()) / 2;
  const Eigen::Vector3d place = sensor * box.center();
  for (int i = 0; i < 3; ++i)
    motion.axes[static_cast<std::size_t>(i)] = {place[i], 0, kFaceVariance, 0, kFirstSpeed * kFirstSpeed};
  low = -half;
  high = half;
  expected = box.center();
  const Eigen::Vector3d along = half.x() >= half.y() ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d facing = sensor.linear() * along;
  yaw = std::atan2(facing.y(), facing.x());
  judge.add(place, half, sensor.linear(), 0);
  seen = age = 1;
  alive = true;
}

void Track::predict(double seconds) {
  before = motion.place();
  // Faster objects accelerate more in curves: 12 m/s at 30 degrees/s are 6 m/s^2.
  motion.predict(seconds, kManoeuvre + kTurnNoise * motion.velocity().squaredNorm());
  unseen += seconds;
}

void Track::expect(const Pose& sensor) {
  expected = sensor.linear().transpose() * (motion.place() - sensor.translation());
}

Aabb Track::static_box(const Pose& sensor) const {
  const Eigen::Vector3d at =
      sensor.linear().transpose() * ((moving ? motion.place() : before) - sensor.translation());
  return {at + low, at + high};
}

Change Track::change_to(const Aabb& seen_box) const {
  const Eigen::Vector3d a = seen_box.min() - expected - low, b = seen_box.max() - expected - high;
  Change change{(a + b) / 2, b - a, Eigen::Vector3d::Zero()};
  for (int i = 0; i < 3; ++i) {
    if (a[i] > 0 && b[i] > 0) change.shift[i] = std::min(a[i], b[i]);
    if (a[i] < 0 && b[i] < 0) change.shift[i] = std::max(a[i], b[i]);
  }
  return change;
}

void Track::correct(const Aabb& seen_box, const Pose& sensor, double seconds) {
  const Change change = change_to(seen_box);
  Eigen::Vector3d surprise, variance;
  for (int i = 0; i < 3; ++i) {
    surprise[i] = innovation_of(change, i);
    variance[i] = kFaceVariance + 0.09 * change.size[i] * change.size[i];
  }
  const Eigen::Matrix3d turn = sensor.linear();
  surprise = turn * surprise;
  variance = turned(turn, variance);
  const double passed = std::max(unseen, seconds);
  for (int i = 0; i < 3; ++i) {
    AxisFilter& axis = motion.axes[static_cast<std::size_t>(i)];
    if (seen == 1 && passed >= kMinStep) {
      axis.start(surprise[i], variance[i], passed);
    } else {
      axis.correct(surprise[i], variance[i]);
    }
  }
  motion.limit_speed(kMaxSpeed);
  expect(sensor);
  for (int i = 0; i < 3; ++i) {
    const double part = std::clamp(std::abs(change.size[i]) / 0.5, 0.3, 1.0);
    low[i] += part * (seen_box.min()[i] - expected[i] - low[i]);
    high[i] += part * (seen_box.max()[i] - expected[i] - high[i]);
  }
  // Make the centre of the box the tracked position. A position off the centre would rotate with the sensor
  // and seem to move (1.5 m off: 0.8 m/s at 30 degrees/s).
  const Eigen::Vector3d offset = (low + high) / 2, moved = turn * offset;
  for (int i = 0; i < 3; ++i)
    motion.axes[static_cast<std::size_t>(i)].place += moved[i];
  low -= offset;
  high -= offset;
  expect(sensor);
  missed = hidden = 0;
  ++seen;
  classify_motion(high, sensor, passed);
  unseen = 0;
}

void Track::classify_motion(const Eigen::Vector3d& half, const Pose& sensor, double seconds) {
  judge.add(motion.place(), half, sensor.linear(), seconds);
  moving = judge.moving();
  const Eigen::Vector3d velocity = motion.velocity(), variance = motion.velocity_variance();
  const double speed = velocity.head<2>().norm(), slowest = 0.35;
  if (!moving || speed < slowest) return;
  yaw = std::atan2(velocity.y(), velocity.x());
  yaw_variance = std::min(1.0, std::max(variance.x(), variance.y()) / (speed * speed));
}

TrackEntry Track::entry(const Pose& sensor, bool fixed, const Eigen::Vector3d& apparent) const {
  TrackEntry entry;
  entry.id = id.value_or(0);
  entry.age = age;
  entry.moving = moving;
  const Eigen::Vector3d centre = expected + (low + high) / 2;
  const Eigen::Matrix3d turn =
      fixed ? Eigen::Matrix3d::Identity() : Eigen::Matrix3d(sensor.linear().transpose());
  entry.velocity = motion.velocity();
  if (!fixed) entry.velocity = turn * entry.velocity + apparent;
  const Eigen::Vector3d place = fixed ? Eigen::Vector3d(sensor * centre) : centre;
  const Eigen::Vector3d facing = turn * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0);
  entry.pose = {place.x(), place.y(), place.z(), std::atan2(facing.y(), facing.x())};
  const auto block = [&](const Eigen::Vector3d& diagonal) {
    return Eigen::Matrix3d(turn * diagonal.asDiagonal() * turn.transpose());
  };
  const Eigen::Matrix3d places = block(motion.position_variance()), both = block(motion.covariance()),
                        velocities = block(motion.velocity_variance());
  Eigen::Matrix<double, 6, 6> all = Eigen::Matrix<double, 6, 6>::Zero();
  all.topLeftCorner<3, 3>() = places;
  all(3, 3) = yaw_variance;
  all.topRightCorner<3, 2>() = both.leftCols<2>();
  all.bottomRightCorner<2, 2>() = velocities.topLeftCorner<2, 2>();
  std::size_t next = 0;
  for (Eigen::Index row = 0; row < 6; ++row)
    for (Eigen::Index column = row; column < 6; ++column)
      entry.covariance[next++] = all(row, column);
  return entry;
}

double cost_of(const Track& track, const Aabb& box, double gate) {
  const Change change = track.change_to(box);
  // Not rotated into the sensor's axes: good enough for a gate.
  const Eigen::Vector3d variance = track.motion.position_variance();
  const double slack = kFaceVariance + gate * gate / 16, most = std::max(variance.x(), variance.y());
  double cost = 0;
  for (int i = 0; i < 3; ++i) {
    const double size = track.high[i] - track.low[i];
    const double change_in_size = change.size[i] / (1 + 0.3 * size);
    cost += change.shift[i] * change.shift[i] / ((i < 2 ? most : variance.z()) + slack) +
            change_in_size * change_in_size + 0.1 * change.centre[i] * change.centre[i];
  }
  return cost;
}

}  // namespace pcl_bv
