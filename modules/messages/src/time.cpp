// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <limits>

#include "pcl_bv/messages/types.h"

namespace pcl_bv {
namespace msg {

constexpr std::int64_t kSecond = 1'000'000'000;

Time time_of(std::int64_t nanoseconds) {
  std::int64_t seconds = nanoseconds / kSecond, rest = nanoseconds % kSecond;
  if (rest < 0) {
    --seconds;
    rest += kSecond;
  }
  using Limits = std::numeric_limits<std::int32_t>;
  if (seconds < Limits::min()) return {Limits::min(), 0};
  if (seconds > Limits::max()) return {Limits::max(), 999'999'999};
  return {static_cast<std::int32_t>(seconds), static_cast<std::uint32_t>(rest)};
}

std::int64_t nanoseconds_of(const Time& time) {
  return std::int64_t{time.sec} * kSecond + time.nanosec;
}

}  // namespace msg
}  // namespace pcl_bv
