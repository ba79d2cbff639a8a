// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "sensor_clocks.h"

#include <algorithm>
#include <cmath>

#include "transforms.h"

namespace pcl_bv::detail {
namespace {

constexpr double kMaxClockDifference = 1e9;  // nanoseconds
constexpr int kNoticedClouds = 20;

bool agree(double a, double b) {
  return std::abs(a - b) <= kMaxClockDifference;
}

}  // namespace

std::string SensorClocks::Found::text(const std::string& reference_name) const {
  return "its clock is " + seconds_text(std::abs(difference_ns)) +
         (difference_ns > 0 ? " ahead of" : " behind") + " that of " + reference_name;
}

// Chooses the sensor that the cloud of `sensor` is compared with.
void SensorClocks::choose_reference(std::size_t sensor, double ahead) {
  constexpr std::uint64_t max_clouds_of_others = 20;
  if (!reference_ || (*reference_ != sensor && ++clouds_of_others_ > max_clouds_of_others)) {
    reference_ = sensor;
    clouds_of_others_ = 0;
    return;
  }
  if (*reference_ != sensor) return;
  clouds_of_others_ = 0;
  const double before = *sensors_[sensor].ahead;
  if (agree(ahead, before)) return;
  // If all stamps jump, as after a pause of simulated time, the latest clouds of no other sensor agree with
  // the stamps before, once one cloud of each has come.
  for (std::size_t other = 0; other < sensors_.size(); ++other)
    if (other != sensor && sensors_[other].ahead && agree(*sensors_[other].ahead, before)) reference_ = other;
}

SensorClocks::Found SensorClocks::note(std::size_t sensor, std::int64_t stamp_ns, std::int64_t measured_ns) {
  // Times of damaged messages may be anything: differences of integers could overflow.
  const double ahead = static_cast<double>(stamp_ns) - static_cast<double>(measured_ns);
  choose_reference(sensor, ahead);
  Sensor& own = sensors_[sensor];
  own.ahead = ahead;
  Found found;
  const double difference = ahead - *sensors_[*reference_].ahead;
  found.difference_ns = std::llround(std::clamp(difference, -9e18, 9e18));
  found.unusable = !agree(difference, 0);
  const int direction = std::abs(difference) <= sync_ns_ ? 0 : difference > 0 ? 1 : -1;
  own.differing = direction == 0 ? 0 : own.differing * direction < 0 ? direction : own.differing + direction;
  if (found.unusable) {
    found.reference = reference_;
  } else if (std::abs(own.differing) >= kNoticedClouds && !own.reported) {
    own.reported = true;
    found.reference = reference_;
  }
  return found;
}

void SensorClocks::restart() {
  for (Sensor& sensor : sensors_)
    sensor.ahead.reset();
  reference_.reset();
}

}  // namespace pcl_bv::detail
