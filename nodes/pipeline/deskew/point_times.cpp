// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "point_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_bv::detail {
namespace {

constexpr std::array<TimeUnit, 4> kUnits{{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
constexpr std::size_t kSampleSize = 4096;
constexpr double kShortestSweep = 1e-3, kLongestSweep = 1;  // seconds

bool has_return(const Coordinates& point) {
  return is_valid(point) && (point.x != 0 || point.y != 0 || point.z != 0);
}

// Returns the unit of a span, or null if no unit gives a sweep. Units differ by a factor of 1000, and so do
// the limits of a sweep, so that at most one unit does.
const TimeUnit* unit_of(double span) {
  for (const TimeUnit& unit : kUnits)
    if (span * unit.seconds > kShortestSweep && span * unit.seconds <= kLongestSweep) return &unit;
  return nullptr;
}

}  // namespace

void PointTimes::sample(const FieldView& field, const PointView& points) {
  sample_.clear();
  sample_.reserve(kSampleSize + 1);
  const std::size_t step = points.count / kSampleSize + 1;
  for (std::size_t i = 0; i < points.count; i += step) {
    const double time = field.number(i);
    if (std::isfinite(time) && has_return(load_point(points, i))) sample_.push_back(time);
  }
  std::sort(sample_.begin(), sample_.end());
}

DeskewTimes PointTimes::read(const FieldView& field, const PointView& points, std::int64_t stamp_ns,
                             std::vector<float>& seconds) {
  DeskewTimes times;
  sample(field, points);
  if (sample_.empty()) {
    times.problem = DeskewTimes::Problem::no_time;
    return times;
  }
  const std::size_t tenth = sample_.size() / 10;
  const double median = sample_[sample_.size() / 2],
               span = sample_[sample_.size() - 1 - tenth] - sample_[tenth];
  const TimeUnit* const unit = unit_of(span);
  if (unit == nullptr) {
    times.problem = DeskewTimes::Problem::no_sweep;
    return times;
  }
  times.unit = unit;
  const double second = unit->seconds, limit = 1 / second;
  // From here on, times are relative to the median, where doubles are finer.
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (std::size_t i = 0; i < points.count; ++i) {
    const double offset = field.number(i) - median;
    if (!(std::abs(offset) <= limit)) continue;
    first = std::min(first, offset);
    last = std::max(last, offset);
  }
  const double stamp = static_cast<double>(stamp_ns) * 1e-9, since_stamp = median * second - stamp;
  double zero = first * second;  // the time of the stamp after the median, seconds
  if (std::abs(median * second) <= kLongestSweep) {
    times.origin = DeskewTimes::Origin::stamp;
    zero = -median * second;
  } else if (std::abs(since_stamp) <= kLongestSweep) {
    times.origin = DeskewTimes::Origin::absolute;
    zero = -since_stamp;
  } else {
    times.origin = DeskewTimes::Origin::first_point;
    times.clock_difference = since_stamp;
  }
  times.first = first * second - zero;
  times.last = last * second - zero;
  seconds.resize(points.count);
  for (std::size_t i = 0; i < points.count; ++i) {
    const double offset = field.number(i) - median;
    const bool inside = std::abs(offset) <= limit;
    seconds[i] = inside ? static_cast<float>(offset * second - zero) : 0;
    times.outside += !inside && has_return(load_point(points, i));
  }
  return times;
}

}  // namespace pcl_bv::detail
