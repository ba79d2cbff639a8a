// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "deskewer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pcl_bv/kernels/convert_times.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "sensor_motion.h"

namespace pcl_bv::detail {
namespace {

constexpr double kLongestPoseStep = 1;  // seconds between two poses
constexpr double kMaxSpeed = 100;       // m/s; faster motions are jumps of the poses

// Returns the seconds from one stamp to the next, or nullopt if the second frame does not follow the first.
std::optional<double> seconds_between(std::int64_t before_ns, std::int64_t after_ns) {
  const double seconds = 1e-9 * (static_cast<double>(after_ns) - static_cast<double>(before_ns));
  return seconds > 0 && seconds <= kLongestPoseStep ? std::optional(seconds) : std::nullopt;
}

double norm(const std::array<double, 3>& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// Returns an upper bound of the rotation between a point's time and the stamp, radians.
double max_rotation_angle(const SensorMotion& motion, const DeskewTimes& times) {
  return norm(motion.angular_velocity) * std::max(std::abs(times.first), std::abs(times.last));
}

// Returns whether a point of Frame::seconds was measured at another time than another point of its sensor.
bool has_sweep(const Frame& frame) {
  if (frame.sensors.empty()) return times_differ(frame.seconds, frame.points.count);
  return std::any_of(frame.sensors.begin(), frame.sensors.end(), [&](const SensorPart& part) {
    return times_differ(frame.seconds + part.first, part.count);
  });
}

}  // namespace

std::optional<SensorMotion> Deskewer::motion_of(const Frame& frame) const {
  if (!last_ || last_->from_source != frame.pose.has_value()) return std::nullopt;
  const std::optional<double> step = seconds_between(last_->stamp_ns, frame.header.stamp_ns);
  if (!step) return std::nullopt;
  if (frame.pose) return motion_between(last_->pose, *frame.pose, *step);
  if (!before_last_ || before_last_->from_source) return std::nullopt;
  const std::optional<double> step_before = seconds_between(before_last_->stamp_ns, last_->stamp_ns);
  if (!step_before) return std::nullopt;
  return motion_between(before_last_->pose, last_->pose, *step_before);
}

// Returns the seconds of each point after the stamp. They are undefined if the times have a problem.
const float* Deskewer::read_times(const Frame& frame, UsableIsa isa, DeskewTimes& times) {
  static constexpr TimeUnit kSeconds{"s", 1};
  if (frame.seconds == nullptr) {
    seconds_.resize(frame.points.count);
    const std::int64_t stamp_of_source = frame.header.stamp_ns - frame.stamp_shift_ns;
    times = point_times_.read(isa, *frame.times, frame.points, stamp_of_source, seconds_.data());
    return seconds_.data();
  }
  if (has_sweep(frame)) times.unit = &kSeconds;
  const TimeLimits limits = find_time_limits(isa, frame.seconds, frame.points.count);
  times.first = limits.first;
  times.last = limits.last;
  return frame.seconds;
}

void Deskewer::apply(const Frame& frame, const Execution& execution, DeskewResult& result) {
  result = {};
  const bool has_times = frame.times || frame.seconds != nullptr;
  if (!has_times || frame.points.indices != nullptr || frame.points.source != nullptr) {
    result.outcome = DeskewOutcome::no_times;
    return;
  }
  const std::optional<SensorMotion> motion = motion_of(frame);
  if (!motion || !(norm(motion->velocity) <= kMaxSpeed)) {
    result.outcome = DeskewOutcome::no_motion;
    return;
  }
  const float* const seconds = read_times(frame, execution.isa, result.times);
  const DeskewTimes& times = result.times;
  if (times.problem != DeskewTimes::Problem::none) {
    result.outcome = DeskewOutcome::bad_times;
  } else if (times.unit == nullptr && times.first == 0 && times.last == 0) {
    result.outcome = DeskewOutcome::no_times;
  } else if (!(max_rotation_angle(*motion, times) <= kMaxDeskewAngle)) {
    result.outcome = DeskewOutcome::too_fast;
  } else {
    result.outcome = frame.pose ? DeskewOutcome::by_poses : DeskewOutcome::by_tracks;
    move(frame, seconds, *motion, execution, result);
  }
}

void Deskewer::move(const Frame& frame, const float* seconds, const SensorMotion& motion,
                    const Execution& execution, DeskewResult& result) {
  const PointView& points = frame.points;
  const std::size_t step = 3 * size_of(points.scalar);
  xyz_.resize((points.count * step + sizeof(double) - 1) / sizeof(double));
  auto* const xyz = reinterpret_cast<std::byte*>(xyz_.data());
  for_each_chunk(execution.parallel, chunk_count(points.count), [&](std::size_t chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    const std::size_t begin = chunk * kChunkPoints;
    deskew(execution.isa, loaded.view(), seconds + begin, motion, xyz + begin * step);
  });
  result.points = packed_points(xyz, points.scalar, points.count);
}

void Deskewer::remember(const Pose& pose, std::int64_t stamp_ns, bool from_source) {
  before_last_ = last_;
  last_ = Known{pose, stamp_ns, from_source};
}

}  // namespace pcl_bv::detail
