// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "velodyne_packet.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pcl_bv::detail {
namespace {

constexpr VelodyneModel kVelodyneModels[] = {
    {"VLP-16",
     0x22,
     16,
     0.002,
     110'592,
     2304,
     1,
     {-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15},
     {}},
    {"HDL-32E",
     0x21,
     32,
     0.002,
     46'080,
     1152,
     1,
     {-30.67, -9.33,  -29.33, -8,     -28,    -6.67, -26.67, -5.33,  -25.33, -4,     -24,
      -2.67,  -22.67, -1.33,  -21.33, 0,      -20,   1.33,   -18.67, 2.67,   -17.33, 4,
      -16,    5.33,   -14.67, 6.67,   -13.33, 8,     -12,    9.33,   -10.67, 10.67},
     {}},
    {"VLP-32C",
     0x28,
     32,
     0.004,
     55'296,
     2304,
     2,
     {-25,    -1,     -1.667, -15.639, -11.31, 0,      -0.667, -8.843, -7.254, 0.333,  -0.333,
      -6.148, -5.333, 1.333,  0.667,   -4,     -4.667, 1.667,  1,      -3.667, -3.333, 3.333,
      2.333,  -2.667, -3,     7,       4.667,  -2.333, -2,     15,     10.333, -1.333},
     {1.4, -4.2, 1.4, -1.4, 1.4, -1.4, 4.2, -1.4, 1.4, -4.2, 1.4, -1.4, 4.2, -1.4, 4.2, -1.4,
      1.4, -4.2, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4, 1.4, -1.4, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4}}};

int azimuth_of(const Payload& packet, std::size_t block) {
  return little_endian<std::uint16_t>(velodyne_return(packet, block, 0) - 2);
}

// Returns the number of blocks per firing: 2 in dual return mode, else 1. Both blocks of a firing have the
// same azimuth.
std::size_t blocks_per_firing(const Payload& packet) {
  if (packet.data[kVelodynePacket - 2] != std::byte{0x39}) return 1;
  for (std::size_t i = 0; i < kVelodyneBlocks; i += 2)
    if (azimuth_of(packet, i) != azimuth_of(packet, i + 1)) return 1;
  return 2;
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

std::size_t index_of(const VelodyneModel& model) {
  return static_cast<std::size_t>(&model - std::begin(kVelodyneModels));
}

const VelodyneModel& velodyne_model(std::size_t index) {
  return kVelodyneModels[index];
}

VelodyneFirings::VelodyneFirings(const Payload& packet)
    : blocks(blocks_per_firing(packet)), count(kVelodyneBlocks / blocks) {
  std::array<double, kVelodyneBlocks> differences{};
  for (std::size_t i = 0; i < count; ++i) {
    azimuth[i] = azimuth_of(packet, i * blocks);
    if (i > 0) differences[i - 1] = azimuth_difference(azimuth[i - 1], azimuth[i]);
  }
  auto* const middle = differences.begin() + (count - 1) / 2;
  std::nth_element(differences.begin(), middle, differences.begin() + (count - 1));
  step = *middle;
  const double direction = step < 0 ? -1 : 1;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double turned = rotation_along(azimuth[i], azimuth[i + 1], direction);
    rotation[i + 1] = rotation[i] + turned;
    const bool is_leap = step != 0 && std::abs(turned) > max_step(step);
    advance[i] = !is_leap ? turned : i > 0 ? advance[i - 1] : step;
    if (is_leap) leap[i + 1] = turned - advance[i];
    leaps += leap[i + 1];
  }
  advance[count - 1] = advance[count - 2];
  for (std::size_t i = 1; i + 1 < count; ++i) {
    if (leap[i] == 0 || leap[i + 1] == 0) continue;
    ignore_leaps();
    break;
  }
}

// For a packet with a single firing between two leaps: its azimuth is wrong, and there is no gap.
void VelodyneFirings::ignore_leaps() {
  leap.fill(0);
  leaps = 0;
  advance.fill(step);
  for (std::size_t i = 0; i + 1 < count; ++i)
    rotation[i + 1] = rotation[i] + azimuth_difference(azimuth[i], azimuth[i + 1]);
}

}  // namespace pcl_bv::detail
