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

// Notes a cloud of the reference, or makes the sensor the reference if that is silent.
bool SensorClocks::note_reference(std::size_t sensor, double ahead) {
  constexpr std::uint64_t max_clouds_of_others = 20;
  if (reference_ && *reference_ != sensor && ++clouds_of_others_ <= max_clouds_of_others) return false;
  before_ = reference_ == sensor ? latest_ : ahead;
  latest_ = ahead;
  reference_ = sensor;
  clouds_of_others_ = 0;
  return true;
}

SensorClocks::Found SensorClocks::note(std::size_t sensor, std::int64_t stamp_ns, std::int64_t measured_ns) {
  // Times of damaged messages may be anything: differences of integers could overflow.
  const double ahead = static_cast<double>(stamp_ns) - static_cast<double>(measured_ns);
  Found found;
  if (note_reference(sensor, ahead)) return found;
  // If all stamps jump, as after a pause of simulated time, the clouds agree with the latest one.
  if (!agree(ahead, latest_) && agree(ahead, before_) && !agree(latest_, before_)) {
    found.jumped = reference_;
    reference_ = sensor;
    before_ = latest_ = ahead;
    return found;
  }
  const double difference = ahead - latest_;
  found.difference_ns = std::llround(std::clamp(difference, -9e18, 9e18));
  found.unusable = !agree(difference, 0);
  Sensor& own = sensors_[sensor];
  const int direction = std::abs(difference) <= sync_ns_ ? 0 : difference > 0 ? 1 : -1;
  own.differing = direction == 0 ? 0 : own.differing * direction < 0 ? direction : own.differing + direction;
  const bool lasting = std::abs(own.differing) >= kNoticedClouds && !own.reported;
  own.reported = own.reported || lasting;
  if (found.unusable || lasting) found.reference = reference_;
  return found;
}

void SensorClocks::restart() {
  for (Sensor& sensor : sensors_)
    sensor.differing = 0;
  reference_.reset();
}

}  // namespace pcl_bv::detail
