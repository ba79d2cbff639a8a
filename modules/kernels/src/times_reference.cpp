// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The scalar references of convert_times.cpp, compiled like those of references.cpp.

#include <cmath>
#include <cstring>
#include <limits>

#include "references.h"

namespace pcl_bv::detail {
namespace {

// NaN replaces neither limit.
void include_time(float time, TimeLimits& limits) {
  limits.first = time < limits.first ? time : limits.first;
  limits.last = time > limits.last ? time : limits.last;
}

constexpr TimeLimits kNoLimits{std::numeric_limits<float>::infinity(),
                               -std::numeric_limits<float>::infinity()};

TimeLimits without_negative_zero(const TimeLimits& limits) {
  return {limits.first + 0.F, limits.last + 0.F};
}

template <typename T>
ConvertedTimes convert_each(const TimeRecords& records, const TimeConversion& to, float* seconds) {
  TimeLimits limits = kNoLimits;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < records.count; ++i) {
    T number;
    std::memcpy(&number, records.data + i * records.stride, sizeof number);
    const double offset = static_cast<double>(number) - to.median;
    const bool inside = std::abs(offset) <= to.max_offset;
    seconds[i] = inside ? static_cast<float>(offset * to.unit_seconds - to.stamp_offset) : 0.F;
    outside += !inside;
    include_time(seconds[i], limits);
  }
  return {without_negative_zero(limits), outside};
}

}  // namespace

ConvertedTimes convert_times_reference(const TimeRecords& records, const TimeConversion& to, float* seconds) {
  if (records.type == TimeType::float32) return convert_each<float>(records, to, seconds);
  if (records.type == TimeType::float64) return convert_each<double>(records, to, seconds);
  return convert_each<std::uint32_t>(records, to, seconds);
}

TimeLimits find_time_limits_reference(const float* seconds, std::size_t count) {
  TimeLimits limits = kNoLimits;
  for (std::size_t i = 0; i < count; ++i)
    include_time(seconds[i], limits);
  return without_negative_zero(limits);
}

}  // namespace pcl_bv::detail
