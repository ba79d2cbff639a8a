// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hesai_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "packet_numbers.h"

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kHesaiSecond = 1'000'000'000;   // nanoseconds
constexpr std::int64_t kMaxHesaiPause = 300'000'000;   // nanoseconds; no prediction over longer pauses
constexpr std::int64_t kMaxHesaiTime = 4'000'000'000;  // nanoseconds, limit of SensorPoint::time_ns
constexpr unsigned kLateHesaiPackets = 8;              // a complete sweep waits this number of packets
constexpr unsigned kHesaiRestart = 8;                  // late packets in succession before a restart
constexpr std::size_t kMaxHesaiPoints = std::size_t{1} << 20;  // of a sweep; a Pandar64 measures 460 800

constexpr std::uint32_t kDistanceBits = 0xFFFF;  // of return_bits()

// Returns the distance and, above it, the reflectivity. The fourth byte is of the same packet, because a tail
// follows the last channel.
std::uint32_t return_bits(const std::byte* at) {
  return little_endian<std::uint32_t>(at) & 0xFFFFFFU;
}

// The sensor's time within its second, microseconds.
std::uint32_t microseconds(const Payload& packet, const HesaiModel& model) {
  return little_endian<std::uint32_t>(packet.data + model.tail_at(packet) + model.timestamp) % 1'000'000;
}

// Returns the difference of two times of which only the position in their second is known.
std::int64_t wrapped(std::int64_t nanoseconds) {
  const std::int64_t within = ((nanoseconds % kHesaiSecond) + kHesaiSecond) % kHesaiSecond;
  return within >= kHesaiSecond / 2 ? within - kHesaiSecond : within;
}

void warn_of_dropped(std::uint64_t number, std::uint64_t& warned, const char* which, SweepQueue& queue) {
  if (number > std::exchange(warned, number))
    queue.warnings.add("dropped " + std::to_string(number) + " Hesai packets " + which);
}

}  // namespace

void HesaiSensor::pass_on(Frame& frame, SweepQueue& queue) {
  if (!frame.sweep.points.empty()) queue.whole.push_back(std::move(frame.sweep));
  frame = Frame();
}

void HesaiSensor::finish(SweepQueue& queue) {
  pass_on(previous_, queue);
  pass_on(current_, queue);
  started_ = false;
  late_in_succession_ = 0;
  warn_of_dropped(late_, late_warned_, "that came after their revolution", queue);
  warn_of_dropped(excess_, excess_warned_, "of revolutions with more than 1048576 points", queue);
}

// Returns the rotation from the packet's first firing to its second one. If there is only one, returns the
// rotation since the newest packet for a later one that follows it closely, else 0.
double HesaiSensor::rotation_in(const Payload& packet, double first) const {
  const HesaiModel& model = *geometry_->model;
  const std::size_t step = model.blocks_per_firing(packet);
  if (step < model.blocks) return azimuth_difference(first, model.azimuth(packet, step));
  const auto passed_us = static_cast<std::int64_t>(microseconds(packet, model)) - std::int64_t{last_us_};
  const std::int64_t passed_ns = wrapped(1000 * passed_us);
  constexpr std::int64_t max_firings = 20;  // in which no sensor rotates by 180 degrees
  if (!started_ || passed_ns <= 0 || passed_ns > max_firings * model.firing_ns) return 0;
  return azimuth_difference(azimuth_, first);
}

// Returns the azimuth of the first block plus whole revolutions. Updates the direction of rotation.
double HesaiSensor::unwrapped_azimuth(const Payload& packet) {
  const HesaiModel& model = *geometry_->model;
  const double first = model.azimuth(packet, 0), within = rotation_in(packet, first);
  constexpr double max_step = 1'000;  // a larger one is a leap over the gap of a limited field of view
  if (within != 0 && std::abs(within) < max_step) forward_ = within < 0 ? -1 : 1;
  if (!started_) return first;
  const double rpm = model.rpm(packet);
  const double per_ns =  // hundredths of a degree for each nanosecond
      rpm > 0 ? forward_ * rpm * static_cast<double>(kFullCircle) / 60e9
              : within / static_cast<double>(model.firing_ns);
  const auto passed_us = static_cast<std::int64_t>(microseconds(packet, model)) - std::int64_t{last_us_};
  const double expected = azimuth_ + per_ns * static_cast<double>(wrapped(1000 * passed_us));
  return expected + azimuth_difference(expected, first);
}

bool HesaiSensor::is_too_late(std::int64_t revolution) const {
  const bool before = forward_ * static_cast<double>(revolution - current_.revolution) < 0;
  return current_.active && before && !(previous_.active && revolution == previous_.revolution);
}

HesaiSensor::Frame& HesaiSensor::frame_of(std::int64_t revolution, SweepQueue& queue) {
  if (previous_.active && revolution == previous_.revolution) return previous_;
  if (current_.active && forward_ * static_cast<double>(revolution - current_.revolution) <= 0)
    return current_;
  pass_on(previous_, queue);
  previous_ = std::exchange(current_, Frame());
  current_.active = true;
  current_.revolution = revolution;
  current_.sweep.sensor = *number_;
  current_.sweep.frame_id = "hesai_lidar";
  const std::size_t expected = previous_.sweep.points.size();
  current_.sweep.points = queue.new_points(expected + expected / 8);
  packets_in_frame_ = 0;
  return current_;
}

void HesaiSensor::add(const Payload& packet, SweepQueue& queue) {
  const HesaiModel& model = *geometry_->model;
  if (!number_) number_ = queue.sensors++;
  const std::int64_t pause = packet.time_ns - last_time_ns_;
  if (started_ && (pause > kMaxHesaiPause || pause < -kMaxHesaiPause)) finish(queue);
  last_time_ns_ = packet.time_ns;
  double azimuth = unwrapped_azimuth(packet);
  if (is_too_late(geometry_->frame_at(azimuth))) {
    if (++late_in_succession_ < kHesaiRestart) {
      ++late_;
      return;
    }
    finish(queue);
    azimuth = unwrapped_azimuth(packet);
  }
  late_in_succession_ = 0;
  const std::uint32_t us = microseconds(packet, model);
  if (!started_ || forward_ * (azimuth - azimuth_) > 0) {
    azimuth_ = azimuth;
    last_us_ = us;
  }
  started_ = true;
  Frame& frame = frame_of(geometry_->frame_at(azimuth), queue);
  const auto first = static_cast<std::uint64_t>(256 * model.azimuth(packet, 0));
  if (frame.sweep.points.size() + model.blocks * model.channels > kMaxHesaiPoints) {
    ++excess_;
  } else if (frame.packets.insert(std::uint64_t{us} << 24U | first).second) {
    add_firings(packet, azimuth, queue);
  }
  if (++packets_in_frame_ >= kLateHesaiPackets && previous_.active) pass_on(previous_, queue);
}

void HesaiSensor::add_firings(const Payload& packet, double azimuth, SweepQueue& queue) {
  const HesaiModel& model = *geometry_->model;
  const std::size_t step = model.blocks_per_firing(packet);
  const std::int64_t packet_ns = std::int64_t{1000} * microseconds(packet, model);
  std::int64_t firing = 0;
  for (std::size_t i = 0; i < model.blocks; i += step, ++firing) {
    if (i > 0) azimuth += rotation_along(model.azimuth(packet, i - step), model.azimuth(packet, i), forward_);
    Frame& frame = frame_of(geometry_->frame_at(azimuth), queue);
    const std::int64_t firing_ns = packet_ns + firing * model.firing_ns;
    const std::int64_t time_ns = time_in_sweep(firing_ns, packet.time_ns, frame);
    add_points(model.block(packet, i), step, model.azimuth(packet, i), time_ns, frame.sweep.points);
  }
}

// Returns the time of a firing after the sweep's stamp. Stamps the sweep, or moves its stamp back.
std::int64_t HesaiSensor::time_in_sweep(std::int64_t firing_ns, std::int64_t packet_time_ns,
                                        Frame& frame) const {
  SensorSweep& sweep = frame.sweep;
  if (!std::exchange(frame.stamped, true)) {
    sweep.stamp_ns = packet_time_ns;
    frame.first_ns = firing_ns;
  }
  const std::int64_t since_stamp = wrapped(firing_ns - frame.first_ns);
  if (since_stamp >= 0) return since_stamp;
  for (SensorPoint& point : sweep.points)
    point.time_ns = static_cast<std::uint32_t>(std::min(point.time_ns - since_stamp, kMaxHesaiTime));
  sweep.stamp_ns += since_stamp;
  frame.first_ns += since_stamp;
  return 0;
}

// Appends the returns of a firing. Each return is written, and the next one overwrites it if it is no point,
// because the processor cannot predict which channels have a return.
template <class Directions>
void HesaiSensor::add_returns(const std::byte* block, std::size_t returns, std::int64_t time_ns,
                              const Directions& direction, SensorPoints& points) const {
  const HesaiModel& model = *geometry_->model;
  // Copies, because the compiler must expect that a point's bytes overwrite what is behind a reference.
  const std::size_t channels = model.channels, step = model.channel, to_next = model.block_size();
  const std::size_t before = points.size(), most = returns * channels;
  const std::uint32_t min_distance = model.min_distance;
  if (points.capacity() < before + most) points.reserve(2 * before + most);
  points.resize(before + most);
  SensorPoint* to = points.data() + before;
  const std::uint64_t* const rings_and_times = geometry_->rings_and_times.data();
  const std::uint64_t begin = static_cast<std::uint64_t>(time_ns) << 32U;
  const std::byte* at = block + model.block_header;
  const auto write = [=](SensorPoint* point, std::size_t i, std::uint32_t bits,
                         const HesaiDirection& towards) {
    const Double2 measured = two_doubles(bits & kDistanceBits, bits >> 16U);
    set_point(*point, measured[0] * towards.xy, measured * Double2{towards.z, 1}, rings_and_times[i] + begin,
              0);
    return (bits & kDistanceBits) >= min_distance;
  };
  for (std::size_t i = 0; i < channels; ++i, at += step) {
    const HesaiDirection towards = direction(i);
    const std::uint32_t first = return_bits(at);
    to += write(to, i, first, towards) ? 1 : 0;
    std::uint32_t last = first;
    for (std::size_t which = 1; which < returns; ++which) {
      const std::uint32_t bits = return_bits(at + which * to_next);
      const bool repeated = bits == first || bits == last;
      to += write(to, i, bits, towards) && !repeated ? 1 : 0;
      last = bits;
    }
  }
  points.resize(static_cast<std::size_t>(to - points.data()));
}

void HesaiSensor::add_points(const std::byte* block, std::size_t returns, double azimuth,
                             std::int64_t time_ns, SensorPoints& points) {
  const HesaiGeometry& geometry = *geometry_;
  if (geometry.mirrors) {
    geometry.mirror(azimuth, directions_);
    const HesaiDirection* const directions = directions_.data();
    return add_returns(
        block, returns, time_ns, [=](std::size_t i) { return directions[i]; }, points);
  }
  const auto [sine, cosine] = sine_cosine_of(azimuth);
  const Double2 of_x{cosine, -sine}, of_y{sine, cosine};
  const double *const xs = geometry.x.data(), *const ys = geometry.y.data(), *const zs = geometry.z.data();
  const auto rotated = [=](std::size_t i) { return HesaiDirection{xs[i] * of_x + ys[i] * of_y, zs[i]}; };
  add_returns(block, returns, time_ns, rotated, points);
}

}  // namespace pcl_bv::detail
