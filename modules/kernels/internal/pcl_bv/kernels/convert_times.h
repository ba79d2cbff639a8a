// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts the times of points, as drivers write them, to seconds.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pcl_bv/points/isa.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

enum class TimeType : std::uint8_t { float32, float64, uint32 };

/// The time of each record, in any unit. Times need no alignment.
struct TimeRecords {
  const std::byte* data = nullptr;  ///< Address of the first record's time.
  std::size_t stride = 0;           ///< Bytes from one record to the next.
  std::size_t count = 0;            ///< Number of records.
  TimeType type = TimeType::float32;
};

/// How times become seconds after the stamp. Doubles are finer near the median than near 0.
struct TimeConversion {
  double median = 0;        ///< In the unit of the times.
  double unit_seconds = 1;  ///< Seconds in one unit.
  double stamp_offset = 0;  ///< Stamp minus median, seconds.
  double max_offset = 0;    ///< Of times of the sweep from the median, in the unit of the times.
};

/// Smallest and largest time, seconds after the stamp. Never -0.
struct TimeLimits {
  float first = 0, last = 0;
};

struct ConvertedTimes {
  TimeLimits limits;        ///< Of all seconds that were written. 0 if there are no records.
  std::size_t outside = 0;  ///< Times that are farther than TimeConversion::max_offset, or not finite.
};

/// Writes `(time - median) * unit_seconds - stamp_offset` to `seconds` for each record, computed in double
/// and rounded to float. Times outside the sweep, NaN and infinite times become 0.
///
/// The bits are the same for every `isa`. The caller must hold a FloatEnvironment. O(records).
ConvertedTimes convert_times(UsableIsa isa, const TimeRecords& records, const TimeConversion& to,
                             float* seconds);

/// Returns the limits of `count` times. NaN is ignored. If all times are NaN, the limits are infinity and
/// -infinity; without times they are 0. The bits are the same for every `isa`. O(count).
TimeLimits find_time_limits(UsableIsa isa, const float* seconds, std::size_t count);

}  // namespace detail
}  // namespace pcl_bv
