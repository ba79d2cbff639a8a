// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "point_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pcl_bv/io/number_text.h"
#include "pcl_bv/kernels/convert_times.h"
#include "visit_numbers.h"

namespace pcl_bv::detail {
namespace {

constexpr std::array<TimeUnit, 4> kUnits{{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
constexpr std::size_t kSampleSize = 1024;
constexpr double kShortestSweep = 1e-3, kLongestSweep = 1;  // seconds

// Returns numbers below `count` that are spread evenly for i = 0, 1, ... (multiples of the golden ratio,
// modulo 1). With a constant step, all points of a sample could be those of one beam.
std::size_t spread(std::size_t i, std::size_t count) {
  const std::uint64_t part = static_cast<std::uint64_t>(i) * 11400714819323198485U;
  return static_cast<std::size_t>(std::ldexp(static_cast<double>(part), -64) * static_cast<double>(count)) %
         count;
}

// Returns the unit of a span, or null if no unit gives a sweep. Units differ by a factor of 1000, and so do
// the limits of a sweep, so that at most one unit does.
const TimeUnit* unit_of(double span) {
  for (const TimeUnit& unit : kUnits)
    if (span * unit.seconds > kShortestSweep && span * unit.seconds <= kLongestSweep) return &unit;
  return nullptr;
}

// Returns the earliest of the times that are at most `max_offset` from the median, relative to the median.
double earliest(const FieldView& field, std::size_t count, double median, double max_offset) {
  double first = 0;
  visit_numbers(field, count, [&](std::size_t /*point*/, double number) {
    if (std::abs(number - median) <= max_offset) first = std::min(first, number - median);
  });
  return first;
}

std::optional<TimeType> type_of(const FieldView& field) {
  if (field.type == 'F' && field.size == 4) return TimeType::float32;
  if (field.type == 'F' && field.size == 8) return TimeType::float64;
  if (field.type == 'U' && field.size == 4) return TimeType::uint32;
  return std::nullopt;
}

// Converts times of a type that the kernel does not know, which is rare, through doubles.
ConvertedTimes write_seconds_of_doubles(UsableIsa isa, const FieldView& field, const TimeConversion& to,
                                        std::size_t count, float* seconds) {
  std::array<double, 512> numbers;
  ConvertedTimes all;
  for (std::size_t begin = 0; begin < count; begin += numbers.size()) {
    const std::size_t size = std::min(numbers.size(), count - begin);
    for (std::size_t i = 0; i < size; ++i)
      numbers[i] = field.number(begin + i);
    const TimeRecords records{reinterpret_cast<const std::byte*>(numbers.data()), sizeof(double), size,
                              TimeType::float64};
    const ConvertedTimes block = convert_times(isa, records, to, seconds + begin);
    all.limits.first = begin == 0 ? block.limits.first : std::min(all.limits.first, block.limits.first);
    all.limits.last = begin == 0 ? block.limits.last : std::max(all.limits.last, block.limits.last);
    all.outside += block.outside;
  }
  return all;
}

ConvertedTimes write_seconds(UsableIsa isa, const FieldView& field, const TimeConversion& to,
                             std::size_t count, float* seconds) {
  if (const std::optional<TimeType> type = type_of(field))
    return convert_times(isa, {field.data, field.stride, count, *type}, to, seconds);
  return write_seconds_of_doubles(isa, field, to, count, seconds);
}

// Returns the number of points with a return that are more than `max_offset` from the median, or have no
// time.
std::size_t count_outside(const FieldView& field, const PointView& points, double median, double max_offset) {
  std::size_t outside = 0;
  visit_numbers(field, points.count, [&](std::size_t i, double number) {
    if (!(std::abs(number - median) <= max_offset)) outside += has_return(load_point(points, i));
  });
  return outside;
}

}  // namespace

void PointTimes::sample(const FieldView& field, const PointView& points) {
  sample_.clear();
  sample_.reserve(kSampleSize + 1);
  const std::size_t size = std::min(points.count, kSampleSize);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t point = points.count <= kSampleSize ? i : spread(i, points.count);
    const double time = field.number(point);
    if (std::isfinite(time) && has_return(load_point(points, point))) sample_.push_back(time);
  }
}

// Returns the time at this position of the sorted sample.
double PointTimes::ranked(std::size_t rank) {
  const auto at = sample_.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sample_.begin(), at, sample_.end());
  return *at;
}

DeskewTimes PointTimes::read(UsableIsa isa, const FieldView& field, const PointView& points,
                             std::int64_t stamp_ns, float* seconds) {
  DeskewTimes times;
  sample(field, points);
  if (sample_.empty()) {
    times.problem = DeskewTimes::Problem::no_time;
    return times;
  }
  const std::size_t size = sample_.size(), tenth = size / 10;
  const double median = ranked(size / 2), length = (ranked(size - 1 - tenth) - ranked(tenth)) / 0.8;
  const TimeUnit* const unit = unit_of(length);
  if (unit == nullptr) {
    times.problem = DeskewTimes::Problem::no_sweep;
    return times;
  }
  times.unit = unit;
  const double max_offset = std::min(4 * length, kLongestSweep / unit->seconds);
  const double unit_seconds = unit->seconds, stamp = static_cast<double>(stamp_ns) * 1e-9,
               since_stamp = median * unit_seconds - stamp;
  // Times are computed relative to the median, where doubles are finer.
  double stamp_offset = 0;  // stamp minus median, seconds
  if (std::abs(median * unit_seconds) <= kLongestSweep) {
    times.origin = DeskewTimes::Origin::stamp;
    stamp_offset = -median * unit_seconds;
  } else if (std::abs(since_stamp) <= kLongestSweep) {
    times.origin = DeskewTimes::Origin::absolute;
    stamp_offset = -since_stamp;
  } else {
    times.origin = DeskewTimes::Origin::first_point;
    times.clock_difference = since_stamp;
    stamp_offset = earliest(field, points.count, median, max_offset) * unit_seconds;
  }
  const ConvertedTimes converted =
      write_seconds(isa, field, {median, unit_seconds, stamp_offset, max_offset}, points.count, seconds);
  times.first = converted.limits.first;
  times.last = converted.limits.last;
  if (converted.outside > 0) times.outside = count_outside(field, points, median, max_offset);
  return times;
}

bool times_differ(const float* seconds, std::size_t count) {
  return std::any_of(seconds, seconds + count, [&](float time) { return time != *seconds; });
}

std::string times_warning(const DeskewTimes& times) {
  std::string text;
  if (times.origin == DeskewTimes::Origin::first_point)
    text = "the times of the points differ from the stamp by " + general_text(times.clock_difference, 6) +
           " s: the first point is assumed to have the time of the stamp";
  if (times.outside > 0)
    text += (text.empty() ? "" : "; ") + std::to_string(times.outside) +
            " points have no time of the sweep, or a time far from its median: they are not moved";
  return text;
}

}  // namespace pcl_bv::detail
