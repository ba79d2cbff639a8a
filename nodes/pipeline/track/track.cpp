// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "track.h"

#include <algorithm>
#include <cmath>

#include "face_shift.h"

namespace pcl_bv::detail {
namespace {

constexpr double kFaceVariance = 0.1 * 0.1;  // m^2; variance of a measured face
constexpr double kFirstSpeed = 8;            // m/s; standard deviation of an unknown velocity
constexpr double kManoeuvre = 0.3;           // m^2/s^3; noise density of 1.7 m/s^2 every 0.1 s
constexpr double kTurnNoise = 0.1;           // 1/s; noise density per squared speed: 57 degrees/s every 0.1 s
constexpr double kMaxSpeed = 60;             // m/s; limit of the speed
// Objects that are static until this detection are slowed down. With a limit of 3, a car at 10 m/s that came
// into view part by part was reported at 1 m/s after eight frames.
constexpr std::size_t kStaticDetections = 5;
constexpr double kStandingSpeed = 0.5;   // m/s; standard deviation of the velocity of objects that stand
constexpr double kMaxStandingSpeed = 1;  // m/s; limit of the reported speed of such objects
constexpr double kMaxJump = 2;           // standard deviations; larger displacements of a face are jumps
constexpr double kMinVehicleLength = 1.5, kMaxVehicleLength = 7;  // m
constexpr double kPartialViewCost = 0.5;  // of a box that is a part of the stored extents
constexpr double kMinStep = 0.03;         // seconds; smallest step that gives a first velocity

// Returns the variances along the axes after a rotation R, which are the diagonal of R diag(v) R^T.
Eigen::Vector3d rotated_variances(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& variances) {
  return rotation.cwiseAbs2() * variances;
}

// Returns the displacement of the visible face. Uses the near face. If it jumps by more than `limit`, because
// another object occludes it or has merged with it, uses the far face. If both jump, or if sensors see both
// faces, uses face_shift().
double visible_face_shift(const BoxDifference& difference, VisibleFace visible, int axis, double limit) {
  if (visible == VisibleFace::both) return difference.shift(axis);
  const bool is_low = visible == VisibleFace::low;
  const double near = is_low ? difference.low[axis] : difference.high[axis],
               far = is_low ? difference.high[axis] : difference.low[axis];
  if (std::abs(near) <= limit) return near;
  return std::abs(far) <= limit ? far : difference.shift(axis);
}

// Returns the innovation. If the size changes by at most 0.05 m, the innovation is the shift of the centre.
// If the size changes by 0.25 m or more, it is the shift of the visible face. In between, it is a weighted
// mean of both shifts.
double innovation_of(const BoxDifference& difference, VisibleFace visible, int axis, double limit) {
  const double part = std::clamp((std::abs(difference.size(axis)) - 0.05) / 0.2, 0.0, 1.0);
  return (1 - part) * difference.centre(axis) + part * visible_face_shift(difference, visible, axis, limit);
}

}  // namespace

double BoxDifference::shift(int axis) const {
  return face_shift(low[axis], high[axis]);
}

void Track::start(const Aabb& box, const Pose& sensor) {
  *this = Track();
  const Eigen::Vector3d half = (box.max() - box.min()) / 2;
  const Eigen::Vector3d position = sensor * box.center();
  for (int i = 0; i < 3; ++i)
    motion.axes[static_cast<std::size_t>(i)] = {position[i], 0, kFaceVariance, 0, kFirstSpeed * kFirstSpeed};
  low = full_low = seen_low = -half;
  high = full_high = seen_high = half;
  expected_position = box.center();
  const Eigen::Vector3d long_axis =
      half.x() >= half.y() ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d facing = sensor.linear() * long_axis;
  yaw = std::atan2(facing.y(), facing.x());
  motion_classifier.add(position, half, sensor.linear(), 0);
  detections = age = 1;
  active = true;
}

void Track::predict(double seconds) {
  previous_position = motion.position();
  // Faster objects accelerate more in curves: 12 m/s at 30 degrees/s are 6 m/s^2.
  motion.predict(seconds, kManoeuvre + kTurnNoise * motion.velocity().squaredNorm());
  seconds_unseen += seconds;
  if (moving) known.box.translate(seconds * motion.velocity());
}

void Track::expect(const Pose& sensor) {
  expected_position = sensor.linear().transpose() * (motion.position() - sensor.translation());
}

Aabb Track::static_box(const Pose& sensor) const {
  const Eigen::Vector3d at =
      sensor.linear().transpose() * ((moving ? motion.position() : previous_position) - sensor.translation());
  return {at + seen_low, at + seen_high};
}

BoxDifference Track::difference_to(const Aabb& seen_box) const {
  const Eigen::Vector3d min = seen_box.min() - expected_position, max = seen_box.max() - expected_position;
  const Eigen::Vector3d below = (full_low - min).cwiseMax(0), above = (max - full_high).cwiseMax(0);
  BoxDifference difference{min - low, max - high, Eigen::Vector3d::Zero(), full_high - full_low - max + min};
  // A box that is larger on both sides is not outside: it may be the object and its neighbour.
  for (int i = 0; i < 3; ++i)
    if (below[i] == 0 || above[i] == 0) difference.outside[i] = below[i] + above[i];
  return difference;
}

bool Track::has_vehicle_size() const {
  const double length = (full_high - full_low).head<2>().maxCoeff();
  return length >= kMinVehicleLength && length <= kMaxVehicleLength;
}

void Track::correct(const Aabb& seen_box, const Pose& sensor, double seconds, const Viewpoints& viewpoints) {
  const double passed = std::max(seconds_unseen, seconds);
  measure(difference_to(seen_box), sensor, viewpoints, seen_box, passed);
  resize(seen_box, sensor);
  missed = occluded = 0;
  inside_of.reset();
  ++detections;
  classify_motion(high, sensor, passed);
  seconds_unseen = 0;
}

void Track::measure(const BoxDifference& difference, const Pose& sensor, const Viewpoints& viewpoints,
                    const Aabb& seen_box, double passed) {
  const Eigen::Matrix3d rotation = sensor.linear();
  const Eigen::Vector3d prior = rotated_variances(rotation.transpose(), motion.position_variance());
  Eigen::Vector3d innovation, variance;
  for (int i = 0; i < 3; ++i) {
    const VisibleFace visible = viewpoints.visible_face(Eigen::Vector3d::Unit(i), Eigen::Vector3d::Zero(),
                                                        seen_box.min()[i], seen_box.max()[i]);
    innovation[i] = innovation_of(difference, visible, i, kMaxJump * std::sqrt(prior[i] + kFaceVariance));
    variance[i] = kFaceVariance + 0.09 * difference.size(i) * difference.size(i);
  }
  innovation = rotation * innovation;
  variance = rotated_variances(rotation, variance);
  for (int i = 0; i < 3; ++i) {
    AxisFilter& axis = motion.axes[static_cast<std::size_t>(i)];
    if (detections == 1 && passed >= kMinStep) {
      axis.start(innovation[i], variance[i], passed);
    } else {
      axis.correct(innovation[i], variance[i]);
    }
  }
  motion.limit_speed(kMaxSpeed);
  expect(sensor);
}

void Track::resize(const Aabb& seen_box, const Pose& sensor) {
  for (int i = 0; i < 3; ++i) {
    // A part that grew for one frame, because the object was one cluster with its neighbour, must not replace
    // the whole size.
    const double below = seen_box.min()[i] - expected_position[i],
                 above = seen_box.max()[i] - expected_position[i];
    const double change = (above - below) - (high[i] - low[i]);
    const double part = std::clamp(std::abs(change) / 0.5, 0.3, 0.5);
    low[i] += part * (below - low[i]);
    high[i] += part * (above - high[i]);
    follow_faces(full_low[i], full_high[i], below, above);
  }
  // Moves the tracked position to the centre of the box. A position off the centre would rotate with the
  // sensor and seem to move: at 0.8 m/s for 1.5 m off the centre and 30 degrees/s.
  const Eigen::Vector3d offset = (low + high) / 2, fixed_offset = sensor.linear() * offset;
  for (int i = 0; i < 3; ++i)
    motion.axes[static_cast<std::size_t>(i)].position += fixed_offset[i];
  for (Eigen::Vector3d* const face : {&low, &high, &full_low, &full_high})
    *face -= offset;
  expect(sensor);
  seen_low = seen_box.min() - expected_position;
  seen_high = seen_box.max() - expected_position;
}

// The box of an object that stands still jumps by decimetres if other parts of it come into view. Without
// this step, such objects would often be reported as faster than 1 m/s.
void Track::slow_down() {
  for (std::size_t i = 0; i < 2; ++i)
    motion.axes[i].slow_down(kStandingSpeed);
}

void Track::classify_motion(const Eigen::Vector3d& half, const Pose& sensor, double seconds) {
  motion_classifier.add(motion.position(), half, sensor.linear(), seconds);
  moving = motion_classifier.moving();
  if (!moving && detections >= kStaticDetections) slow_down();
  const Eigen::Vector3d velocity = motion.velocity(), variance = motion.velocity_variance();
  const double speed = velocity.head<2>().norm(), slowest = 0.35;
  if (!moving || speed < slowest) return;
  yaw = std::atan2(velocity.y(), velocity.x());
  yaw_variance = std::min(1.0, std::max(variance.x(), variance.y()) / (speed * speed));
}

TrackEntry Track::entry(const Pose& sensor, bool fixed, const Eigen::Vector3d& apparent_velocity) const {
  TrackEntry entry;
  entry.id = id.value_or(0);
  entry.age = age;
  entry.moving = moving;
  const Eigen::Vector3d centre = expected_position + (low + high) / 2;
  const Eigen::Matrix3d rotation =
      fixed ? Eigen::Matrix3d::Identity() : Eigen::Matrix3d(sensor.linear().transpose());
  entry.velocity = motion.velocity();
  // `moving` and the velocity must not contradict each other.
  const double speed = entry.velocity.head<2>().norm();
  if (!moving && speed > kMaxStandingSpeed) {
    const double variance = motion.velocity_variance().head<2>().maxCoeff();
    entry.moving = !motion_classifier.decided() && speed * speed > 9 * variance;
  }
  // The factor makes up for rounding: programs compare with the limit.
  if (const double all = entry.velocity.norm(); !entry.moving && all > kMaxStandingSpeed)
    entry.velocity *= (1 - 1e-12) * kMaxStandingSpeed / all;
  if (!fixed) entry.velocity = rotation * entry.velocity + apparent_velocity;
  const Eigen::Vector3d position = fixed ? Eigen::Vector3d(sensor * centre) : centre;
  const Eigen::Vector3d facing = rotation * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0);
  entry.pose = {position.x(), position.y(), position.z(), std::atan2(facing.y(), facing.x())};
  const auto block = [&](const Eigen::Vector3d& diagonal) {
    return Eigen::Matrix3d(rotation * diagonal.asDiagonal() * rotation.transpose());
  };
  const Eigen::Matrix3d positions = block(motion.position_variance()), both = block(motion.covariance()),
                        velocities = block(motion.velocity_variance());
  Eigen::Matrix<double, 6, 6> all = Eigen::Matrix<double, 6, 6>::Zero();
  all.topLeftCorner<3, 3>() = positions;
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
  const BoxDifference difference = track.difference_to(box);
  // The variance along the axes of the fixed frame is accurate enough for a gate, so it is not rotated into
  // the sensor's axes.
  const Eigen::Vector3d variance = track.motion.position_variance();
  const double slack = kFaceVariance + gate * gate / 16, max_variance = std::max(variance.x(), variance.y());
  const auto square = [](double value) { return value * value; };
  double whole = 0, part = kPartialViewCost;
  for (int i = 0; i < 3; ++i) {
    const double size = track.high[i] - track.low[i], full = track.full_high[i] - track.full_low[i];
    const double scale = (i < 2 ? max_variance : variance.z()) + slack, centre = square(difference.centre(i));
    whole += square(difference.shift(i)) / scale + square(difference.size(i) / (1 + 0.3 * size)) + centre;
    part +=
        square(difference.outside[i]) / scale + square(difference.unseen[i] / (1 + 0.3 * full)) + centre / 4;
  }
  return track.id && track.has_vehicle_size() ? std::min(whole, part) : whole;
}

}  // namespace pcl_bv::detail
