// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hesai_model.h"

#include <algorithm>

namespace pcl_bv::detail {
namespace {

constexpr std::byte kHesaiUnit{4};  // millimetres

// Time from the firing of each channel to the end of the firing sequence, nanoseconds.
constexpr std::int64_t kPandar40Firing[] = {
    42220, 28470, 16040, 3620,  45490, 31740, 47460, 54670, 20620, 33710, 40910, 8190,  20620, 27160,
    50730, 8190,  14740, 36980, 45490, 52700, 23890, 31740, 38950, 11470, 18650, 25190, 48760, 6230,
    12770, 35010, 21920, 9500,  43520, 29770, 17350, 4920,  42220, 28470, 16040, 3620};
constexpr std::int64_t kPandar64Firing[] = {
    23180, 21876, 20572, 19268, 17964, 16660, 11444, 46796, 7532,  36956, 50732, 54668, 40892,
    44828, 31052, 34988, 48764, 52700, 38924, 42860, 29084, 33020, 46796, 25148, 36956, 50732,
    27116, 40892, 44828, 31052, 34988, 48764, 25148, 38924, 42860, 29084, 33020, 52700, 6228,
    54668, 15356, 27116, 10140, 23180, 4924,  21876, 14052, 17964, 8836,  19268, 3620,  20572,
    12748, 16660, 7532,  11444, 6228,  15356, 10140, 4924,  3620,  14052, 8836,  12748};

bool starts_with(const Payload& packet, std::initializer_list<unsigned> bytes) {
  std::size_t at = 0;
  for (const unsigned byte : bytes) {
    if (packet.data[at++] != std::byte(byte)) return false;
  }
  return true;
}

// The packet is long enough for all that is inspected.
bool has_header_of(const Payload& packet, const HesaiModel& model) {
  const auto channels = static_cast<unsigned>(model.channels), blocks = static_cast<unsigned>(model.blocks);
  if (model.header == 12)
    return starts_with(packet, {0xEE, 0xFF, 6, 1}) && packet.data[6] == std::byte(channels) &&
           packet.data[7] == std::byte(blocks) && packet.data[9] == kHesaiUnit;
  if (model.header == 8)
    return starts_with(packet, {0xEE, 0xFF, channels, blocks}) && packet.data[5] == kHesaiUnit;
  for (std::size_t i = 0; i < model.blocks; ++i) {
    const std::byte* const block = model.block(packet, i);
    if (block[0] != std::byte{0xFF} || block[1] != std::byte{0xEE}) return false;
  }
  return true;
}

bool is_of(const Payload& packet, const HesaiModel& model) {
  if (packet.size != model.packet_size() && packet.size != model.packet_size() + 4) return false;
  if (!has_header_of(packet, model) || model.blocks_per_firing(packet) == 0) return false;
  for (std::size_t i = 0; i < model.blocks; ++i) {
    if (model.azimuth(packet, i) > 36'000) return false;
  }
  return true;
}

}  // namespace

std::size_t HesaiModel::blocks_per_firing(const Payload& packet) const {
  switch (std::to_integer<unsigned>(packet.data[tail_at() + return_mode])) {
    case 0x37:  // strongest
    case 0x38:  // last
      return 1;
    case 0x39:  // last and strongest
      return 2;
    default:
      return 0;
  }
}

const std::vector<HesaiModel>& hesai_models() {
  static const std::vector<HesaiModel> models{
      {"PandarXT-32", 32, 8, 12, 2, 4, 24, 10, 11, 19, 50'000, true},
      {"PandarXT-16", 16, 8, 12, 2, 4, 24, 10, 11, 19, 50'000, true},
      {"Pandar64", 64, 6, 8, 2, 3, 22, 14, 8, 10, 55'560, false},
      {"Pandar40", 40, 10, 0, 4, 3, 22, 14, 8, 10, 55'560, false},
  };
  return models;
}

const HesaiModel* hesai_model(const Payload& packet) {
  for (const HesaiModel& model : hesai_models()) {
    if (is_of(packet, model)) return &model;
  }
  return nullptr;
}

std::vector<HesaiAngles> published_angles(const HesaiModel& model) {
  std::vector<HesaiAngles> angles;
  if (!model.has_published_angles) return angles;
  const double step = model.channels == 32 ? 1 : 2;
  for (std::size_t i = 0; i < model.channels; ++i)
    angles.push_back({15 - step * static_cast<double>(i), 0});
  return angles;
}

std::vector<std::int64_t> hesai_firing_times(const HesaiModel& model) {
  std::vector<std::int64_t> times(model.channels);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i);
    times[i] = model.channels == 40   ? model.firing_ns - kPandar40Firing[i]
               : model.channels == 64 ? model.firing_ns - kPandar64Firing[i]
               : model.channels == 32 ? 6'000 + 1'512 * number
                                      : 6'000 + 3'024 * number;
  }
  return times;
}

}  // namespace pcl_bv::detail
