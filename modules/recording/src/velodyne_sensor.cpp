// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "packet_numbers.h"

namespace pcl_bv::detail {

// A sensor model. A block has 32 returns, one per beam in the order of `elevation`. A VLP-16 fires its 16
// beams twice per block.
struct VelodyneModel {
  std::string_view name;
  std::uint8_t product_id;  // the last byte of a packet
  std::size_t beams;
  double distance_unit;                                // metres
  double block_ns, laser_ns;                           // mean time between blocks, and between lasers
  std::array<double, kVelodyneLasers> elevation;       // of each beam, degrees
  std::array<double, kVelodyneLasers> azimuth_offset;  // of each beam, degrees
};

namespace {

constexpr std::size_t kBlock = 100, kBlocks = 12;
constexpr double kDegree = 3.14159265358979323846 / 180;

constexpr VelodyneModel kVelodyneModels[] = {
    {"VLP-16",
     0x22,
     16,
     0.002,
     110'592,
     2304,
     {-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15},
     {}},
    {"HDL-32E",
     0x21,
     32,
     0.002,
     46'080,
     1152,
     {-30.67, -9.33,  -29.33, -8,     -28,    -6.67, -26.67, -5.33,  -25.33, -4,     -24,
      -2.67,  -22.67, -1.33,  -21.33, 0,      -20,   1.33,   -18.67, 2.67,   -17.33, 4,
      -16,    5.33,   -14.67, 6.67,   -13.33, 8,     -12,    9.33,   -10.67, 10.67},
     {}},
    {"VLP-32C",
     0x28,
     32,
     0.004,
     55'296,
     1152,
     {-25,    -1,     -1.667, -15.639, -11.31, 0,      -0.667, -8.843, -7.254, 0.333,  -0.333,
      -6.148, -5.333, 1.333,  0.667,   -4,     -4.667, 1.667,  1,      -3.667, -3.333, 3.333,
      2.333,  -2.667, -3,     7,       4.667,  -2.333, -2,     15,     10.333, -1.333},
     {1.4, -4.2, 1.4, -1.4, 1.4, -1.4, 4.2, -1.4, 1.4, -4.2, 1.4, -1.4, 4.2, -1.4, 4.2, -1.4,
      1.4, -4.2, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4, 1.4, -1.4, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4}}};

constexpr double kMaxPause = 0.3e9;            // nanoseconds; azimuths cannot be predicted over longer pauses
constexpr double kMaxPredictionError = 6'000;  // hundredths of a degree, for packets of the same sensor
constexpr unsigned kLatePackets = 8;           // a complete sweep waits this number of packets for late ones

int azimuth_of(const Payload& packet, std::size_t block) {
  return little_endian<std::uint16_t>(packet.data + kBlock * block + 2);
}

const std::byte* return_of(const Payload& packet, std::size_t block, std::size_t laser) {
  return packet.data + kBlock * block + 4 + 3 * laser;
}

// Returns the number of blocks per firing: 2 in dual return mode, else 1.
std::size_t step_of(const Payload& packet) {
  return std::to_integer<int>(packet.data[kVelodynePacket - 2]) == 0x39 ? 2 : 1;
}

// Returns the signed difference of two azimuths in hundredths of a degree, from -18000 to 18000.
double azimuth_difference(double from, double to) {
  return std::remainder(to - from, static_cast<double>(kFullCircle));
}

// Returns the rotation from the first to the last firing of the packet.
double rotation_within(const Payload& packet) {
  return azimuth_difference(azimuth_of(packet, 0), azimuth_of(packet, kBlocks - step_of(packet)));
}

}  // namespace

int velodyne_product(const Payload& packet) {
  if (packet.size != kVelodynePacket || little_endian<std::uint16_t>(packet.data) != 0xEEFF) return -1;
  return std::to_integer<int>(packet.data[kVelodynePacket - 1]);
}

const VelodyneModel* velodyne_model(const Payload& packet) {
  const int product = velodyne_product(packet);
  const auto* const found =
      std::find_if(std::begin(kVelodyneModels), std::end(kVelodyneModels),
                   [&](const VelodyneModel& model) { return model.product_id == product; });
  return found == std::end(kVelodyneModels) ? nullptr : found;
}

std::string_view name_of(const VelodyneModel& model) {
  return model.name;
}

std::size_t number_of(const VelodyneModel& model) {
  return static_cast<std::size_t>(&model - std::begin(kVelodyneModels));
}

const VelodyneModel& velodyne_model(std::size_t number) {
  return kVelodyneModels[number];
}

VelodyneSensor::VelodyneSensor(const VelodyneModel& model, std::size_t number)
    : model_(&model), number_(number) {
  std::array<double, kVelodyneLasers> sorted = model.elevation;
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(model.beams));
  for (std::size_t i = 0; i < model.beams; ++i) {
    ring_[i] = static_cast<std::uint32_t>(std::find(sorted.begin(), sorted.end(), model.elevation[i]) -
                                          sorted.begin());
    sine_[i] = std::sin(model.elevation[i] * kDegree);
    cosine_[i] = std::cos(model.elevation[i] * kDegree);
    azimuth_offset_[i] =
        static_cast<std::size_t>(std::lround(100 * model.azimuth_offset[i]) + static_cast<long>(kFullCircle));
  }
  sweep_ = previous_ = empty_sweep();
}

SensorSweep VelodyneSensor::empty_sweep() const {
  SensorSweep sweep;
  sweep.sensor = number_;
  sweep.frame_id = "velodyne";
  return sweep;
}

// Returns the rotation from the first block of the newest packet to the first block of `packet`. Whole
// revolutions are included; their number is the one that fits the time of `packet` best.
double VelodyneSensor::rotation_since_last(const Payload& packet) const {
  const double expected = speed_ * static_cast<double>(packet.time_ns - last_time_ns_);
  return expected + azimuth_difference(azimuth_ + expected, azimuth_of(packet, 0));
}

bool VelodyneSensor::expects(const Payload& packet) const {
  const auto passed = static_cast<double>(packet.time_ns - last_time_ns_);
  if (!started_ || std::abs(passed) > kMaxPause) return true;
  return std::abs(rotation_since_last(packet) - speed_ * passed) <= kMaxPredictionError;
}

// Estimates the rotation speed. The first estimate is from the first packet alone and assumes the model's
// block_ns. Each later packet and its predecessor update the estimate with a smoothing factor of 1/8, so that
// the jitter of a single packet has little effect.
void VelodyneSensor::update_speed(const Payload& packet, double rotation) {
  const std::size_t firings = kBlocks / step_of(packet) - 1;
  if (speed_ == 0) speed_ = rotation_within(packet) / (static_cast<double>(firings) * model_->block_ns);
  const auto passed = static_cast<double>(packet.time_ns - last_time_ns_);
  if (!started_ || !(passed > 0.2e6 && passed < 5e6) || rotation * speed_ <= 0 || std::abs(rotation) > 3'000)
    return;
  speed_ += (rotation / passed - speed_) / 8;
}

void VelodyneSensor::begin_revolution(std::int64_t revolution, std::deque<SensorSweep>& whole) {
  revolution_ = revolution;
  packets_in_revolution_ = 0;
  if (!previous_.points.empty()) whole.push_back(std::move(previous_));
  previous_ = std::exchange(sweep_, empty_sweep());
}

void VelodyneSensor::finish(std::deque<SensorSweep>& whole) {
  for (SensorSweep* const sweep : {&previous_, &sweep_}) {
    if (!sweep->points.empty()) whole.push_back(std::move(*sweep));
    *sweep = empty_sweep();
  }
  started_ = false;
}

void VelodyneSensor::add(const Payload& packet, std::deque<SensorSweep>& whole) {
  if (started_ && std::abs(static_cast<double>(packet.time_ns - last_time_ns_)) > kMaxPause) finish(whole);
  const double rotation = started_ ? rotation_since_last(packet) : 0;
  update_speed(packet, rotation);
  const std::size_t step = step_of(packet);
  const double forward = speed_ < 0 ? -1 : 1;
  double azimuth = started_ ? azimuth_ + rotation : azimuth_of(packet, 0);
  if (!started_) revolution_ = static_cast<std::int64_t>(std::floor(azimuth / kFullCircle));
  if (!started_ || forward * rotation > 0) {
    azimuth_ = azimuth;
    last_time_ns_ = packet.time_ns;
  }
  started_ = true;
  // The second firing of a VLP-16's block is half way to the next block. The rotation per block is the
  // rotation between the packet's first two blocks.
  const double half = azimuth_difference(azimuth_of(packet, 0), azimuth_of(packet, step)) / 2;
  for (std::size_t block = 0; block < kBlocks; block += step) {
    if (block > 0) azimuth += azimuth_difference(azimuth_of(packet, block - step), azimuth_of(packet, block));
    for (std::size_t laser = 0; laser < kVelodyneLasers; ++laser) {
      const double at = laser >= model_->beams ? azimuth + half : azimuth;
      auto revolution = static_cast<std::int64_t>(std::floor(at / kFullCircle));
      if (at > azimuth && at == static_cast<double>(revolution) * kFullCircle) --revolution;
      if (forward * static_cast<double>(revolution - revolution_) > 0) begin_revolution(revolution, whole);
      const bool late = revolution != revolution_ && !previous_.points.empty();
      SensorSweep& sweep = late ? previous_ : sweep_;
      if (sweep.points.empty()) sweep.stamp_ns = packet.time_ns;
      const std::size_t firing = block / step;
      const double time = static_cast<double>(packet.time_ns - sweep.stamp_ns) +
                          static_cast<double>(firing) * model_->block_ns +
                          static_cast<double>(laser) * model_->laser_ns;
      add_firing(packet, block, laser, at - std::floor(at / kFullCircle) * kFullCircle, time, sweep);
    }
  }
  if (++packets_in_revolution_ < kLatePackets || previous_.points.empty()) return;
  whole.push_back(std::exchange(previous_, empty_sweep()));
}

void VelodyneSensor::add_firing(const Payload& packet, std::size_t block, std::size_t laser, double azimuth,
                                double time, SensorSweep& sweep) const {
  const std::byte* const one = return_of(packet, block, laser);
  add_point(one, laser, azimuth, time, sweep);
  if (step_of(packet) == 1) return;
  const std::byte* const other = return_of(packet, block + 1, laser);
  if (std::memcmp(one, other, 3) != 0) add_point(other, laser, azimuth, time, sweep);
}

void VelodyneSensor::add_point(const std::byte* at, std::size_t laser, double hundredths, double time,
                               SensorSweep& sweep) const {
  const double distance = little_endian<std::uint16_t>(at) * model_->distance_unit;
  if (distance == 0) return;  // no return
  const std::size_t beam = laser < model_->beams ? laser : laser - model_->beams;  // two firings in a block
  const SineCosine& azimuth =
      sine_cosine_table()[(static_cast<std::size_t>(hundredths) + azimuth_offset_[beam]) % kFullCircle];
  const double level = distance * cosine_[beam];
  sweep.points.push_back(
      {static_cast<float>(level * azimuth.sine), static_cast<float>(level * azimuth.cosine),
       static_cast<float>(distance * sine_[beam]), static_cast<float>(std::to_integer<int>(at[2])),
       ring_[beam], static_cast<std::uint32_t>(std::clamp(time, 0.0, 4e9)), 0});
}

}  // namespace pcl_bv::detail
