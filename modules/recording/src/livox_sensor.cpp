// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "livox_sensor.h"

#include <libdeflate.h>

#include <cmath>
#include <utility>

#include "packet_numbers.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint64_t kLivoxFrameTime = 100'000'000;  // nanoseconds
constexpr std::int64_t kMaxLivoxPause = 1'000'000'000;  // nanoseconds; the sensor may have restarted after it
constexpr unsigned kLateLivoxPackets = 8;               // a complete frame waits this number of packets
// Late packets in succession after which the sensor's clock, or the program that plays a capture back, has
// restarted.
constexpr unsigned kLivoxRestart = 8;
constexpr std::size_t kMaxLivoxPoints = std::size_t{1} << 20;  // of a frame; a HAP measures 45 200

// Sets the coordinates of a point in integers of `units_per_metre`. Returns false if it is no return.
template <class Integer>
bool set_cartesian(const std::byte* at, double units_per_metre, SensorPoint& point) {
  const auto x = little_endian<Integer>(at), y = little_endian<Integer>(at + sizeof(Integer)),
             z = little_endian<Integer>(at + 2 * sizeof(Integer));
  point.x = static_cast<float>(x / units_per_metre);
  point.y = static_cast<float>(y / units_per_metre);
  point.z = static_cast<float>(z / units_per_metre);
  return x != 0 || y != 0 || z != 0;
}

// Sets the coordinates of a point from its depth in millimetres, zenith angle and azimuth.
bool set_spherical(const std::byte* at, SensorPoint& point) {
  const double depth = little_endian<std::uint32_t>(at) / 1000.0;
  const SineCosine& zenith = sine_cosine_table()[little_endian<std::uint16_t>(at + 4) % kFullCircle];
  const SineCosine& azimuth = sine_cosine_table()[little_endian<std::uint16_t>(at + 6) % kFullCircle];
  point.x = static_cast<float>(depth * zenith.sine * azimuth.cosine);
  point.y = static_cast<float>(depth * zenith.sine * azimuth.sine);
  point.z = static_cast<float>(depth * zenith.cosine);
  return depth != 0;
}

bool set_coordinates(std::uint8_t data_type, const std::byte* at, SensorPoint& point) {
  if (data_type == 1) return set_cartesian<std::int32_t>(at, 1000, point);
  if (data_type == 2) return set_cartesian<std::int16_t>(at, 100, point);
  return set_spherical(at, point);
}

void warn_of(std::uint64_t number, std::uint64_t& warned, const char* which, SweepQueue& queue) {
  if (number > std::exchange(warned, number))
    queue.warnings.add("dropped " + std::to_string(number) + " Livox packets " + which);
}

}  // namespace

void LivoxSensor::pass_on(Frame& frame, SweepQueue& queue) {
  if (!frame.sweep.points.empty()) queue.whole.push_back(std::move(frame.sweep));
  frame = Frame();
}

void LivoxSensor::begin_frame(std::uint64_t number, const Payload& packet, const LivoxPacket& header,
                              SweepQueue& queue) {
  pass_on(previous_, queue);
  previous_ = std::exchange(current_, Frame());
  current_.active = true;
  current_.number = number;
  current_.first_time = header.first_time_ns;
  current_.sweep.stamp_ns = packet.time_ns;
  current_.sweep.sensor = *number_;
  current_.sweep.has_ring = false;
  current_.sweep.has_tag = true;
  current_.sweep.frame_id = "livox_frame";
  const std::size_t expected = previous_.sweep.points.size();
  current_.sweep.points = queue.new_points(expected + expected / 8 + header.points);
  packets_in_frame_ = 0;
}

void LivoxSensor::finish(SweepQueue& queue) {
  pass_on(previous_, queue);
  pass_on(current_, queue);
  late_in_succession_ = 0;
  warn_of(late_, late_warned_, "that came after their frame", queue);
  warn_of(damaged_, damaged_warned_, "with a wrong checksum", queue);
  warn_of(excess_, excess_warned_, "of frames with more than 1048576 points", queue);
}

// The protocol has a checksum, but Livox' SDK does not check it. So a wrong one only counts if the sensor has
// sent a correct one before.
bool LivoxSensor::is_damaged(const Payload& packet, const LivoxPacket& header) {
  const std::uint32_t computed =
      libdeflate_crc32(0, packet.data + kLivoxChecked, packet.size - kLivoxChecked);
  if (computed == header.checksum) has_checksums_ = true;
  return computed != header.checksum && has_checksums_;
}

// Returns the frame of the packet, or null for a packet that is too late.
LivoxSensor::Frame* LivoxSensor::frame_of(const Payload& packet, const LivoxPacket& header,
                                          SweepQueue& queue) {
  const std::int64_t passed = packet.time_ns - last_time_ns_;
  if (current_.active && (passed > kMaxLivoxPause || passed < -kMaxLivoxPause)) finish(queue);
  last_time_ns_ = packet.time_ns;
  const std::uint64_t number = header.first_time_ns / kLivoxFrameTime;
  if (previous_.active && number == previous_.number) {
    late_in_succession_ = 0;
    return &previous_;
  }
  if (current_.active && number < current_.number) {
    if (++late_in_succession_ < kLivoxRestart) {
      ++late_;
      return nullptr;
    }
    finish(queue);
  }
  late_in_succession_ = 0;
  if (!current_.active || number != current_.number) begin_frame(number, packet, header, queue);
  return &current_;
}

void LivoxSensor::add(const Payload& packet, SweepQueue& queue) {
  LivoxPacket header;
  if (!read_livox_packet(packet, header)) return;
  if (!number_) number_ = queue.sensors++;
  if (is_damaged(packet, header)) {
    ++damaged_;
    return;
  }
  Frame* const frame = frame_of(packet, header, queue);
  if (frame == nullptr) return;
  if (frame->sweep.points.size() + header.points > kMaxLivoxPoints) {
    ++excess_;
  } else if (frame->packets.insert(header.first_time_ns).second) {
    add_points(packet.data + kLivoxHeader, header, *frame);
  }
  if (++packets_in_frame_ >= kLateLivoxPackets && previous_.active) pass_on(previous_, queue);
}

void LivoxSensor::add_points(const std::byte* points, const LivoxPacket& header, Frame& frame) {
  SensorSweep& sweep = frame.sweep;
  if (header.first_time_ns < frame.first_time) {
    const std::uint64_t earlier = frame.first_time - header.first_time_ns;  // less than 100 ms
    for (SensorPoint& point : sweep.points)
      point.time_ns += static_cast<std::uint32_t>(earlier);
    sweep.stamp_ns -= static_cast<std::int64_t>(earlier);
    frame.first_time = header.first_time_ns;
  }
  const std::uint64_t since_stamp = header.first_time_ns - frame.first_time;
  const std::uint64_t intervals = header.points > 1 ? header.points - 1 : 1;
  const std::size_t size = livox_point_size(header.data_type);
  for (std::size_t i = 0; i < header.points; ++i, points += size) {
    SensorPoint point;
    if (!set_coordinates(header.data_type, points, point)) continue;
    point.intensity = std::to_integer<std::uint8_t>(points[size - 2]);
    point.ring = std::to_integer<std::uint8_t>(points[size - 1]);  // the tag
    point.time_ns = static_cast<std::uint32_t>(since_stamp + i * header.duration_ns / intervals);
    point.reflectivity = 0;
    sweep.points.push_back(point);
  }
}

}  // namespace pcl_bv::detail
