// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "sensor_presence.h"

#include <algorithm>
#include <utility>

#include "transforms.h"

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kShortestSilence = 300'000'000;
constexpr std::int64_t kSilenceOfUnknownPeriod = 1'000'000'000;

}  // namespace

bool is_power_of_ten(std::uint64_t number) {
  while (number % 10 == 0 && number > 0)
    number /= 10;
  return number == 1;
}

void SensorPresence::note_gap(std::int64_t gap_ns) {
  period_ns_ = std::min(period_ns_.value_or(gap_ns), gap_ns);
}

std::string SensorPresence::end_silence(std::int64_t stamp_ns) {
  if (!std::exchange(silent_, false) || !is_power_of_ten(silences_)) return {};
  return "sends clouds again, at " + seconds_text(stamp_ns);
}

std::string SensorPresence::note_frame(bool present, std::int64_t stamp_ns) {
  in_last_frame_ = present;
  if (present || !last_used_ns_) last_used_ns_ = stamp_ns;
  if (present) return end_silence(stamp_ns);
  const std::int64_t longest =
      period_ns_ ? std::max(kShortestSilence, 3 * *period_ns_) : kSilenceOfUnknownPeriod;
  if (silent_ || stamp_ns - *last_used_ns_ < longest) return {};
  silent_ = true;
  if (!is_power_of_ten(++silences_)) return {};
  return "no clouds for " + seconds_text(longest) + "; the frames from " + seconds_text(stamp_ns) +
         " on have only the other sensors'";
}

void SensorPresence::restart() {
  last_used_ns_.reset();
  silent_ = false;
  in_last_frame_ = true;
}

}  // namespace pcl_bv::detail
