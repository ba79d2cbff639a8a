// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_sensor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pcl_bv::detail {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kMaxPause = 0.3e9;   // nanoseconds; azimuths cannot be predicted over longer pauses
constexpr double kMaxTime = 4e9;      // nanoseconds, limit of SensorPoint::time_ns
constexpr double kMinGap = 500;       // hundredths of a degree; smaller gaps do not limit the field of view
constexpr unsigned kLatePackets = 8;  // a complete sweep waits this number of packets for late ones

}  // namespace

VelodyneSensor::VelodyneSensor(const VelodyneModel& model, std::size_t number)
    : model_(&model), number_(number) {
  std::array<double, kVelodyneLasers> sorted = model.elevation;
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(model.beams));
  for (std::size_t i = 0; i < model.beams; ++i) {
    ring_[i] = static_cast<std::uint32_t>(std::find(sorted.begin(), sorted.end(), model.elevation[i]) -
                                          sorted.begin());
    sine_[i] = std::sin(model.elevation[i] * kDegree);
    cosine_[i] = std::cos(model.elevation[i] * kDegree);
    azimuth_offset_[i] = static_cast<double>(std::lround(100 * model.azimuth_offset[i]));
  }
  for (std::size_t i = 0; i < kVelodyneLasers; ++i) {
    laser_ns_[i] = model.laser_time(i);
    laser_part_[i] = laser_ns_[i] / model.block_ns;
  }
  sweep_ = previous_ = empty_sweep();
}

SensorSweep VelodyneSensor::empty_sweep() const {
  SensorSweep sweep;
  sweep.sensor = number_;
  sweep.frame_id = "velodyne";
  return sweep;
}

// Returns the time between the captures of the newest packet and of this one, nanoseconds.
double VelodyneSensor::since_last(const Payload& packet) const {
  return static_cast<double>(packet.time_ns - last_time_ns_);
}

// Returns the time between the first firings of the newest packet and of this one by the sensor's clock, in
// nanoseconds. Returns nullopt if the clock stands still, or if it is not that of the newest packet.
std::optional<double> VelodyneSensor::clock_since_last(const Payload& packet) const {
  constexpr double hour = 3.6e9;            // microseconds, after which the clock begins at 0
  constexpr double max_difference = 0.2e9;  // nanoseconds
  const std::uint32_t us = velodyne_clock(packet);
  const double passed = 1000 * std::remainder(static_cast<double>(us) - last_us_, hour);
  if (us == last_us_ || std::abs(passed - since_last(packet)) > max_difference) return std::nullopt;
  return passed;
}

// Whole revolutions are included; their number is the one that fits the time of `packet` best.
VelodyneSensor::Rotation VelodyneSensor::rotation_since_last(const Payload& packet,
                                                             const VelodyneFirings& firings) const {
  // The sensor's clock has the time of the first firing. The capture time is that of the last one.
  const std::optional<double> clock = clock_since_last(packet);
  const double last = azimuth_ + newest_total_, first = firings.azimuth[0];
  const double expected = speed_ * clock.value_or(since_last(packet));
  const double difference = clock ? azimuth_difference(azimuth_ + expected, first)
                                  : azimuth_difference(last + expected, first + firings.total());
  const double direction = firings.step < 0 ? -1 : 1, to_first = azimuth_difference(last, first);
  const bool follows =
      direction * to_first > 0 && std::abs(to_first) <= VelodyneFirings::max_step(firings.step);
  // A program that plays a capture back may skip the time of a gap in the field of view.
  if (follows && (firings.leaps != 0 || std::abs(difference) > kMaxDifference))
    return {newest_total_ + to_first, std::min(std::abs(difference), kMaxDifference), true};
  const double offset = clock ? 0 : newest_total_ - firings.total();
  return {std::round(expected + difference) + offset, std::abs(difference), follows};
}

double VelodyneSensor::difference(const Payload& packet) const {
  if (!started_ || std::abs(since_last(packet)) > kMaxPause) return kMaxDifference;
  return rotation_since_last(packet, VelodyneFirings(packet)).difference;
}

// Estimates the rotation speed. The first estimate is from the first packet alone and assumes the model's
// block_ns. Packets that follow their predecessors closely replace it by the mean of their speeds, which has
// a smoothing factor of 1/8, so that the jitter of a single packet has little effect.
void VelodyneSensor::update_speed(const Payload& packet, const VelodyneFirings& firings, double rotation) {
  if (speed_ == 0) speed_ = firings.step / model_->block_ns;
  if (!started_) return;
  const double passed = clock_since_last(packet).value_or(since_last(packet));
  if (!(passed > 0.2e6 && passed < 5e6) || rotation * speed_ <= 0 || std::abs(rotation) > 3'000) return;
  measured_speeds_ = std::min(measured_speeds_ + 1, 8U);
  speed_ += (rotation / passed - speed_) / measured_speeds_;
}

// Returns the number of the revolution at an unwrapped azimuth.
std::int64_t VelodyneSensor::revolution_at(double azimuth) const {
  return static_cast<std::int64_t>(std::floor((azimuth - begin_azimuth_) / kRevolution));
}

// Notes that the azimuth leaps within a packet. Revolutions then begin in the gap.
void VelodyneSensor::note_leap(double from, double to) {
  if (std::abs(to - from) < kMinGap) return;
  const bool was_known = std::exchange(has_gap_, true);
  if (revolution_at(from) != revolution_at(to)) return;
  // The first passage of the field of view may have been divided at azimuth 0.
  if (!was_known && std::abs(from - first_azimuth_) < kRevolution) join_sweeps();
  const double middle = (from + to) / 2;
  begin_azimuth_ = middle - std::floor(middle / kRevolution) * kRevolution;
  revolution_ = revolution_at(from);
}

// Joins the previous and the current sweep.
void VelodyneSensor::join_sweeps() {
  if (previous_.points.empty()) return;
  const std::int64_t later = sweep_.points.empty() ? 0 : sweep_.stamp_ns - previous_.stamp_ns;
  for (SensorPoint& point : sweep_.points) {
    point.time_ns =
        static_cast<std::uint32_t>(std::clamp(static_cast<double>(point.time_ns + later), 0.0, kMaxTime));
    previous_.points.push_back(point);
  }
  sweep_ = std::exchange(previous_, empty_sweep());
}

void VelodyneSensor::begin_revolution(std::int64_t revolution, std::deque<SensorSweep>& whole) {
  revolution_ = revolution;
  packets_in_revolution_ = 0;
  if (!previous_.points.empty()) whole.push_back(std::move(previous_));
  previous_ = std::exchange(sweep_, empty_sweep());
}

// Returns the sweep of a revolution: a new one, the current one or, for a late packet, the previous one.
SensorSweep& VelodyneSensor::sweep_of(std::int64_t revolution, std::deque<SensorSweep>& whole) {
  if (forward() * static_cast<double>(revolution - revolution_) > 0) begin_revolution(revolution, whole);
  return revolution != revolution_ && !previous_.points.empty() ? previous_ : sweep_;
}

void VelodyneSensor::finish(std::deque<SensorSweep>& whole) {
  for (SensorSweep* const sweep : {&previous_, &sweep_}) {
    if (!sweep->points.empty()) whole.push_back(std::move(*sweep));
    *sweep = empty_sweep();
  }
  started_ = false;
}

void VelodyneSensor::add(const Payload& packet, std::deque<SensorSweep>& whole) {
  if (started_ && std::abs(since_last(packet)) > kMaxPause) finish(whole);
  const VelodyneFirings firings(packet);
  const auto [rotation, difference, follows] = started_ ? rotation_since_last(packet, firings) : Rotation();
  update_speed(packet, firings, rotation);
  const double azimuth = started_ ? azimuth_ + rotation : firings.azimuth[0];
  if (!started_) {
    revolution_ = revolution_at(azimuth);
    first_azimuth_ = azimuth;
  }
  // Time in which the sensor turns by a hundredth of a degree of a gap.
  const double gap_ns =
      follows && firings.leaps != 0
          ? std::max(since_last(packet) - static_cast<double>(firings.count) * model_->block_ns, 0.0) /
                firings.leaps
          : model_->block_ns / firings.step;
  if (!started_ || forward() * rotation > 0) {
    azimuth_ = azimuth;
    newest_total_ = firings.total();
    last_time_ns_ = packet.time_ns;
    last_us_ = velodyne_clock(packet);
  }
  started_ = true;
  add_firings(packet, firings, azimuth, gap_ns, whole);
  // The first sweep waits for a whole revolution, see note_leap().
  const bool may_join = !has_gap_ && std::abs(azimuth_ - first_azimuth_) < kRevolution;
  if (++packets_in_revolution_ < kLatePackets || may_join || previous_.points.empty()) return;
  whole.push_back(std::exchange(previous_, empty_sweep()));
}

// Adds the firings of a packet whose first firing is at the unwrapped `azimuth`. `gap_ns` is the time for
// each hundredth of a degree of a gap.
void VelodyneSensor::add_firings(const Payload& packet, const VelodyneFirings& firings, double azimuth,
                                 double gap_ns, std::deque<SensorSweep>& whole) {
  double leaps = firings.leaps;  // those after the current firing
  for (std::size_t i = 0; i < firings.count; ++i) {
    const double at = azimuth + firings.rotation[i];
    leaps -= firings.leap[i];
    if (firings.leap[i] != 0) note_leap(azimuth + firings.rotation[i - 1], at);
    // The capture time is that of the firings after all leaps.
    const std::int64_t begin_ns = packet.time_ns - (leaps == 0 ? 0 : std::llround(leaps * gap_ns));
    for (std::size_t laser = 0; laser < kVelodyneLasers; laser += model_->beams) {
      const double turned = at + firings.advance[i] * laser_part_[laser];
      std::int64_t revolution = revolution_at(turned);
      // PCL's grabber does not begin a revolution with a VLP-16's second firing at exactly 0.
      if (turned > at && turned - begin_azimuth_ == static_cast<double>(revolution) * kRevolution)
        --revolution;
      SensorSweep& sweep = sweep_of(revolution, whole);
      if (sweep.points.empty()) sweep.stamp_ns = begin_ns;
      const double time_ns =
          static_cast<double>(begin_ns - sweep.stamp_ns) + static_cast<double>(i) * model_->block_ns;
      add_lasers(packet, firings.blocks,
                 {i * firings.blocks, time_ns, firings.azimuth[i], firings.advance[i]}, laser, sweep);
    }
  }
}

// Adds the returns of all beams from a laser on.
void VelodyneSensor::add_lasers(const Payload& packet, std::size_t blocks, const Firing& firing,
                                std::size_t first_laser, SensorSweep& sweep) const {
  for (std::size_t laser = first_laser; laser < first_laser + model_->beams; ++laser) {
    const std::byte* const one = velodyne_return(packet, firing.block, laser);
    add_point(one, laser, firing, sweep);
    if (blocks == 1) continue;
    const std::byte* const other = velodyne_return(packet, firing.block + 1, laser);
    if (std::memcmp(one, other, 3) != 0) add_point(other, laser, firing, sweep);
  }
}

void VelodyneSensor::add_point(const std::byte* at, std::size_t laser, const Firing& firing,
                               SensorSweep& sweep) const {
  const double distance = little_endian<std::uint16_t>(at) * model_->distance_unit;
  if (distance == 0) return;  // no return
  const std::size_t beam = laser % model_->beams;
  const SineCosine azimuth =
      sine_cosine_of(firing.azimuth + firing.advance * laser_part_[laser] + azimuth_offset_[beam]);
  const double level = distance * cosine_[beam];
  sweep.points.push_back(
      {static_cast<float>(level * azimuth.sine), static_cast<float>(level * azimuth.cosine),
       static_cast<float>(distance * sine_[beam]), static_cast<float>(std::to_integer<int>(at[2])),
       ring_[beam], static_cast<std::uint32_t>(std::clamp(firing.time_ns + laser_ns_[laser], 0.0, kMaxTime)),
       0});
}

}  // namespace pcl_bv::detail
