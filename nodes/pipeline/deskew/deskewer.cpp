// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "deskewer.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "sensor_motion.h"

namespace pcl_bv::detail {
namespace {

constexpr double kLongestStep = 1;  // seconds between two poses

// Returns the seconds from one stamp to the next, or nullopt if the second frame does not follow the first.
std::optional<double> seconds_between(std::int64_t before_ns, std::int64_t after_ns) {
  const double seconds = 1e-9 * (static_cast<double>(after_ns) - static_cast<double>(before_ns));
  return seconds > 0 && seconds <= kLongestStep ? std::optional(seconds) : std::nullopt;
}

// Returns the largest rotation about any axis within the sweep, radians.
double largest_turn(const SensorMotion& motion, const DeskewTimes& times) {
  const auto& w = motion.rotation;
  return std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) *
         std::max(std::abs(times.first), std::abs(times.last));
}

}  // namespace

std::optional<SensorMotion> Deskewer::motion_of(const Frame& frame) const {
  if (!last_ || last_->given != frame.pose.has_value()) return std::nullopt;
  const std::optional<double> step = seconds_between(last_->stamp_ns, frame.header.stamp_ns);
  if (!step) return std::nullopt;
  if (frame.pose) return motion_between(last_->pose, *frame.pose, *step);
  if (!before_last_ || before_last_->given) return std::nullopt;
  const std::optional<double> step_before = seconds_between(before_last_->stamp_ns, last_->stamp_ns);
  if (!step_before) return std::nullopt;
  return motion_between(before_last_->pose, last_->pose, *step_before);
}

void Deskewer::apply(const Frame& frame, const Execution& execution, DeskewResult& result) {
  result = {};
  if (!frame.times || frame.points.indices != nullptr || frame.points.source != nullptr) {
    result.outcome = DeskewOutcome::no_times;
    return;
  }
  const std::optional<SensorMotion> motion = motion_of(frame);
  if (!motion) {
    result.outcome = DeskewOutcome::no_motion;
    return;
  }
  result.times = point_times_.read(*frame.times, frame.points, frame.header.stamp_ns, seconds_);
  if (result.times.problem != DeskewTimes::Problem::none) {
    result.outcome = DeskewOutcome::bad_times;
  } else if (largest_turn(*motion, result.times) > kMaxDeskewAngle) {
    result.outcome = DeskewOutcome::too_fast;
  } else {
    result.outcome = frame.pose ? DeskewOutcome::by_poses : DeskewOutcome::by_tracks;
    move(frame, *motion, execution, result);
  }
}

void Deskewer::move(const Frame& frame, const SensorMotion& motion, const Execution& execution,
                    DeskewResult& result) {
  const PointView& points = frame.points;
  const std::size_t step = 3 * size_of(points.scalar);
  xyz_.resize((points.count * step + sizeof(double) - 1) / sizeof(double));
  auto* const xyz = reinterpret_cast<std::byte*>(xyz_.data());
  for_each_chunk(execution.parallel, chunk_count(points.count), [&](std::size_t chunk) {
    const LoadedPoints loaded = load_chunk(points, chunk);
    const std::size_t begin = chunk * kChunkPoints;
    deskew(execution.isa, loaded.view(), seconds_.data() + begin, motion, xyz + begin * step);
  });
  result.points = packed_points(xyz, points.scalar, points.count);
}

void Deskewer::remember(const Pose& pose, std::int64_t stamp_ns, bool given) {
  before_last_ = last_;
  last_ = Known{pose, stamp_ns, given};
}

}  // namespace pcl_bv::detail
