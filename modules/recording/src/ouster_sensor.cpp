// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ouster_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "packet_numbers.h"
#include "sensor_point.h"

namespace pcl_bv::detail {
namespace {

constexpr double kOusterPi = 3.14159265358979323846;
constexpr std::int64_t kMaxOusterPause = 1'000'000'000;  // nanoseconds; frame ids may restart after it
constexpr std::int64_t kMaxTimeBack = 1'000'000'000;     // nanoseconds that a sweep's stamp may move back
constexpr std::int64_t kMaxSweepTime = 4'000'000'000;    // nanoseconds, limit of SensorPoint::time_ns
constexpr unsigned kLateOusterPackets = 8;  // a complete frame waits this number of packets for late ones
// Late packets in succession after which the sensor, or the program that plays a capture back, has restarted.
constexpr unsigned kRestartPackets = 8;

template <const OusterProfile& profile>
std::uint32_t range_mm(const std::byte* channel, std::size_t which) {
  const std::byte* const at = channel + profile.at[which].range;
  const std::uint32_t raw =
      profile.range_mask <= 0xFFFF ? little_endian<std::uint16_t>(at) : little_endian<std::uint32_t>(at);
  return (raw & profile.range_mask) * profile.range_unit_mm;
}

template <const OusterProfile& profile>
std::uint32_t reflectivity(const std::byte* channel, std::size_t which) {
  const std::byte* const at = channel + profile.at[which].reflectivity;
  return profile.reflectivity_bytes == 2 ? little_endian<std::uint16_t>(at)
                                         : std::to_integer<std::uint32_t>(*at);
}

template <const OusterProfile& profile>
std::uint32_t intensity(const std::byte* channel, std::size_t which) {
  return profile.has_signal ? little_endian<std::uint16_t>(channel + profile.at[which].signal)
                            : reflectivity<profile>(channel, which);
}

}  // namespace

OusterGeometry::OusterGeometry(const OusterMetadata& metadata) {
  constexpr double degree = kOusterPi / 180, metre = 0.001;
  const double bx = metadata.beam_x_mm, bz = metadata.beam_z_mm;
  beam_distance_mm = bz == 0 ? bx : std::hypot(bx, bz);
  for (std::size_t i = 0; i < metadata.beams; ++i) {
    const double azimuth = -metadata.azimuths[i] * degree, altitude = metadata.altitudes[i] * degree;
    x.push_back(std::cos(azimuth) * std::cos(altitude));
    y.push_back(std::sin(azimuth) * std::cos(altitude));
    z.push_back(std::sin(altitude));
  }
  const auto& t = metadata.lidar_to_sensor;
  upright = t[2] == 0 && t[6] == 0 && t[8] == 0 && t[9] == 0;
  const auto entry = [&](std::size_t row, std::size_t column) {
    return metadata.lidar_to_sensor[4 * row + column];
  };
  for (std::size_t m = 0; m < metadata.columns_per_frame; ++m) {
    const double part = static_cast<double>(m) / static_cast<double>(metadata.columns_per_frame);
    const double encoder = 2 * kOusterPi * (1 - part);  // of a rotation
    const double c = std::cos(encoder), s = std::sin(encoder);
    Column& column = columns.emplace_back();
    for (std::size_t row = 0; row < 3; ++row) {
      column.rotation[3 * row] = metre * (entry(row, 0) * c + entry(row, 1) * s);
      column.rotation[3 * row + 1] = metre * (entry(row, 1) * c - entry(row, 0) * s);
      column.rotation[3 * row + 2] = metre * entry(row, 2);
      column.origin[row] =
          metre * (entry(row, 0) * bx * c + entry(row, 1) * bx * s + entry(row, 2) * bz + entry(row, 3));
    }
  }
}

OusterSensor::OusterSensor(std::shared_ptr<const OusterMetadata> metadata,
                           std::shared_ptr<const OusterGeometry> geometry)
    : metadata_(std::move(metadata)), geometry_(std::move(geometry)) {}

void OusterSensor::pass_on(Frame& frame, SweepQueue& queue) {
  if (!frame.sweep.points.empty()) queue.whole.push_back(std::move(frame.sweep));
  frame = Frame();
}

void OusterSensor::begin_frame(std::uint16_t id, SweepQueue& queue) {
  pass_on(previous_, queue);
  previous_ = std::exchange(current_, Frame());
  current_.active = true;
  current_.id = id;
  current_.columns.resize(metadata_->columns_per_frame);
  current_.sweep.sensor = *number_;
  current_.sweep.has_reflectivity = true;
  current_.sweep.frame_id = "os_sensor";
  const std::size_t expected = previous_.sweep.points.size();
  current_.sweep.points = queue.new_points(expected + expected / 8 + 2 * metadata_->beams);
  packets_in_frame_ = 0;
}

void OusterSensor::finish(SweepQueue& queue) {
  pass_on(previous_, queue);
  pass_on(current_, queue);
  late_in_succession_ = 0;
  if (late_ > std::exchange(late_warned_, late_))
    queue.warnings.add("dropped " + std::to_string(late_) + " Ouster packets that came after their frame");
}

// Returns the frame of the packet, or null for a packet that is too late.
OusterSensor::Frame* OusterSensor::frame_of(const Payload& packet, SweepQueue& queue) {
  const std::int64_t passed = packet.time_ns - last_time_ns_;
  if (current_.active && (passed > kMaxOusterPause || passed < -kMaxOusterPause)) finish(queue);
  last_time_ns_ = packet.time_ns;
  const auto id = little_endian<std::uint16_t>(packet.data + (metadata_->profile->is_legacy() ? 10 : 2));
  if (previous_.active && id == previous_.id) {
    late_in_succession_ = 0;
    return &previous_;
  }
  // Frame ids have 16 bits and start anew after 65535.
  const auto ahead = static_cast<std::int16_t>(static_cast<std::uint16_t>(id - current_.id));
  if (current_.active && ahead < 0 && ++late_in_succession_ < kRestartPackets) {
    ++late_;
    return nullptr;
  }
  if (current_.active && ahead < 0) finish(queue);
  late_in_succession_ = 0;
  if (!current_.active || ahead != 0) begin_frame(id, queue);
  return &current_;
}

void OusterSensor::add(const Payload& packet, SweepQueue& queue) {
  if (!number_) number_ = queue.sensors++;
  Frame* const frame = frame_of(packet, queue);
  if (frame == nullptr) return;
  const OusterProfile& profile = *metadata_->profile;
  for (std::size_t i = 0; i < metadata_->columns_per_packet; ++i)
    add_column(packet.data + profile.packet_header + i * profile.column_size(metadata_->beams),
               packet.time_ns, *frame);
  if (++packets_in_frame_ >= kLateOusterPackets && previous_.active) pass_on(previous_, queue);
}

void OusterSensor::add_column(const std::byte* column, std::int64_t packet_time_ns, Frame& frame) {
  const OusterProfile& profile = *metadata_->profile;
  const std::size_t channels_size = metadata_->beams * profile.channel;
  const bool valid =
      profile.is_legacy()
          ? little_endian<std::uint32_t>(column + profile.column_header + channels_size) == 0xFFFFFFFF
          : (little_endian<std::uint16_t>(column + 10) & 1U) != 0;
  const std::size_t id = little_endian<std::uint16_t>(column + 8);
  if (!valid || id >= frame.columns.size() || frame.columns[id]) return;
  frame.columns[id] = true;
  SensorSweep& sweep = frame.sweep;
  const auto time = little_endian<std::uint64_t>(column);
  if (!std::exchange(frame.stamped, true)) {
    sweep.stamp_ns = packet_time_ns;
    frame.first_time = time;
  }
  auto since_stamp = static_cast<std::int64_t>(time - frame.first_time);
  if (since_stamp < 0 && since_stamp > -kMaxTimeBack) {
    for (SensorPoint& point : sweep.points)
      point.time_ns = static_cast<std::uint32_t>(std::min(point.time_ns - since_stamp, kMaxSweepTime));
    sweep.stamp_ns += since_stamp;
    frame.first_time = time;
    since_stamp = 0;
  }
  const auto time_ns = static_cast<std::uint32_t>(std::clamp<std::int64_t>(since_stamp, 0, kMaxSweepTime));
  const std::byte* const channels = column + profile.column_header;
  const OusterGeometry::Column& place = geometry_->columns[id];
  if (&profile == &kOusterLegacy) return add_returns<kOusterLegacy>(channels, place, time_ns, sweep.points);
  if (&profile == &kOusterSingle) return add_returns<kOusterSingle>(channels, place, time_ns, sweep.points);
  if (&profile == &kOusterDual) return add_returns<kOusterDual>(channels, place, time_ns, sweep.points);
  add_returns<kOusterLowRate>(channels, place, time_ns, sweep.points);
}

// Appends the returns of a column. Each return is written, and the next one overwrites it if it is no point,
// because the processor cannot predict which beams have a return.
template <const OusterProfile& profile, bool upright>
void OusterSensor::add_points(const std::byte* channels, const OusterGeometry::Column& column,
                              std::uint32_t time_ns, SensorPoints& points) const {
  const OusterGeometry& geometry = *geometry_;
  const auto& [m, origin] = column;
  const Double2 of_x{m[0], m[3]}, of_y{m[1], m[4]}, of_z{m[2], m[5]}, origin_xy{origin[0], origin[1]};
  const std::size_t beams = metadata_->beams, before = points.size();
  const std::size_t most = profile.returns * beams;
  if (points.capacity() < before + most) {
    // A frame that has this number of points will probably be complete, and one allocation is faster.
    constexpr std::size_t many_points = 4'096;
    const std::size_t frame = metadata_->columns_per_frame * most;
    points.reserve(std::max(2 * before + most, before < many_points ? 0 : frame));
  }
  points.resize(before + most);
  SensorPoint* to = points.data() + before;
  // Copies, because the compiler must expect that a point's bytes overwrite what is behind a reference.
  const double m6 = m[6], m7 = m[7], m8 = m[8];
  const Double2 near{geometry.beam_distance_mm, 0}, origin_z{origin[2], 0};
  const double *const xs = geometry.x.data(), *const ys = geometry.y.data(), *const zs = geometry.z.data();
  const std::uint64_t time = std::uint64_t{time_ns} << 32U;
  const auto write = [=](SensorPoint* point, std::size_t i, std::size_t which, const std::byte* channel,
                         Double2 xy, double z) {
    const std::uint32_t range = range_mm<profile>(channel, which);
    const Double2 measured = two_doubles(range, intensity<profile>(channel, which)) - near;
    set_point(*point, measured[0] * xy + origin_xy, measured * Double2{z, 1} + origin_z, time | i,
              reflectivity<profile>(channel, which));
    return range;
  };
  for (std::size_t i = 0; i < beams; ++i) {
    const std::byte* const channel = channels + i * profile.channel;
    Double2 xy = xs[i] * of_x + ys[i] * of_y;
    double z = m8 * zs[i];
    if constexpr (!upright) {
      xy += zs[i] * of_z;
      z += m6 * xs[i] + m7 * ys[i];
    }
    const std::uint32_t first = write(to, i, 0, channel, xy, z);
    to += first != 0 ? 1 : 0;
    if constexpr (profile.returns == 2) {
      const std::uint32_t second = write(to, i, 1, channel, xy, z);
      const bool repeated = first == second &&
                            intensity<profile>(channel, 1) == intensity<profile>(channel, 0) &&
                            reflectivity<profile>(channel, 1) == reflectivity<profile>(channel, 0);
      to += second != 0 && !repeated ? 1 : 0;
    }
  }
  points.resize(static_cast<std::size_t>(to - points.data()));
}

template <const OusterProfile& profile>
void OusterSensor::add_returns(const std::byte* channels, const OusterGeometry::Column& column,
                               std::uint32_t time_ns, SensorPoints& points) const {
  if (geometry_->upright) return add_points<profile, true>(channels, column, time_ns, points);
  add_points<profile, false>(channels, column, time_ns, points);
}

}  // namespace pcl_bv::detail
