// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hesai_model.h"

#include <algorithm>
#include <iterator>

namespace pcl_bv::detail {
namespace {

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

constexpr std::int64_t kPandarQtFiring[] = {
    // from the beginning of the firing sequence
    2310,   4370,   6430,   8490,   10540,  12600,  14660,  16710,  19160,  21220,  23280,  25340,  27390,
    29450,  31500,  33560,  36610,  38670,  40730,  42780,  44840,  46900,  48950,  51010,  53450,  55520,
    57580,  59630,  61690,  63740,  65800,  67860,  70900,  72970,  75020,  77080,  79140,  81190,  83250,
    85300,  87750,  89820,  91870,  93930,  95980,  98040,  100100, 102150, 105200, 107260, 109320, 111380,
    113430, 115490, 117540, 119600, 122050, 124110, 126170, 128220, 130280, 132340, 134390, 136450,
};
static_assert(std::size(kPandarQtFiring) == 64);

constexpr std::size_t kHesaiFlags = 11;  // position of the flags in a header of 12 bytes
constexpr std::size_t kHesaiChecksum = 4, kHesaiSequence = 4, kHesaiImu = 22, kHesaiSafety = 17,
                      kHesaiSignature = 32;

bool has_flag(const Payload& packet, unsigned bit) {
  return (std::to_integer<unsigned>(packet.data[kHesaiFlags]) >> bit & 1U) != 0;
}

bool starts_with(const Payload& packet, std::initializer_list<unsigned> bytes) {
  std::size_t at = 0;
  for (const unsigned byte : bytes) {
    if (packet.data[at++] != std::byte(byte)) return false;
  }
  return true;
}

bool has_header_of(const Payload& packet, const HesaiModel& model) {
  const auto channels = static_cast<unsigned>(model.channels), blocks = static_cast<unsigned>(model.blocks);
  if (packet.size < model.header + model.blocks * model.block_size()) return false;
  if (model.header == 12) {
    const bool has_fourth_byte = model.trailer == HesaiTrailer::flags && !model.has_mirrors;
    return starts_with(packet, {0xEE, 0xFF, model.major, model.minor}) &&
           packet.data[6] == std::byte(channels) && packet.data[7] == std::byte(blocks) &&
           packet.data[9] == std::byte(model.unit_mm) &&
           (!has_fourth_byte || has_flag(packet, 4) == (model.channel == 4));
  }
  if (model.header == 8)
    return starts_with(packet, {0xEE, 0xFF, channels, blocks}) && packet.data[5] == std::byte(model.unit_mm);
  for (std::size_t i = 0; i < model.blocks; ++i) {
    const std::byte* const block = model.block(packet, i);
    if (block[0] != std::byte{0xFF} || block[1] != std::byte{0xEE}) return false;
  }
  return true;
}

bool is_of(const Payload& packet, const HesaiModel& model) {
  if (!has_header_of(packet, model)) return false;
  const std::size_t size = model.packet_size(packet);
  const bool fits = packet.size == size ||
                    (model.trailer == HesaiTrailer::sequence && packet.size + kHesaiSequence == size);
  if (!fits || model.blocks_per_firing(packet) == 0) return false;
  for (std::size_t i = 0; i < model.blocks; ++i) {
    if (!(model.azimuth(packet, i) < 36'001)) return false;
  }
  return true;
}

}  // namespace

std::size_t HesaiModel::tail_at(const Payload& packet) const {
  const std::size_t end = header + blocks * block_size();
  if (trailer == HesaiTrailer::sequence) return end;
  return end + kHesaiChecksum + (!has_mirrors && has_flag(packet, 2) ? kHesaiSafety : 0);
}

std::size_t HesaiModel::packet_size(const Payload& packet) const {
  const std::size_t end = tail_at(packet) + tail;
  if (trailer == HesaiTrailer::sequence) return end + kHesaiSequence;
  return end + (has_flag(packet, 0) ? kHesaiSequence : 0) +
         (!has_mirrors && has_flag(packet, 1) ? kHesaiImu : 0) + kHesaiChecksum +
         (has_flag(packet, 3) ? kHesaiSignature : 0);
}

std::size_t HesaiModel::blocks_per_firing(const Payload& packet) const {
  switch (std::to_integer<unsigned>(packet.data[tail_at(packet) + return_mode])) {
    case 0x33:  // first
    case 0x34:  // second
    case 0x37:  // strongest
    case 0x38:  // last
      return 1;
    case 0x39:  // last and strongest
    case 0x3A:  // first and second
    case 0x3B:  // first and last
    case 0x3C:  // first and strongest
    case 0x3E:  // strongest and second strongest
      return 2;
    case 0x3D:  // first, last and strongest
      return blocks % 3 == 0 ? 3 : 0;
    default:
      return 0;
  }
}

double HesaiModel::rpm(const Payload& packet) const {
  std::uint16_t value;
  std::memcpy(&value, packet.data + tail_at(packet) + motor_speed, sizeof value);
  // Newer models count in tenths, older ones with the same layout do not. None is faster than 1200 rpm, and
  // an AT128 has at least 200 rpm.
  constexpr std::uint16_t max_rpm = 1'500;
  return trailer == HesaiTrailer::flags && value > max_rpm ? value / 10.0 : value;
}

const std::vector<HesaiModel>& hesai_models() {
  constexpr auto sequence = HesaiTrailer::sequence, flags = HesaiTrailer::flags;
  static const std::vector<HesaiModel> models{
      {"PandarXT-32", 6, 1, 32, 8, 12, 2, 4, 24, 10, 11, 19, 50'000, sequence, 1, true},
      {"PandarXT-16", 6, 1, 16, 8, 12, 2, 4, 24, 10, 11, 19, 50'000, sequence, 1, true},
      {"PandarXT-32M2X", 6, 1, 32, 6, 12, 2, 4, 24, 10, 11, 19, 50'000, sequence, 1, false, 5},
      {"PandarQT", 3, 1, 64, 4, 12, 2, 4, 24, 16, 10, 12, 166'667, sequence, 1},
      {"QT128C2X", 3, 2, 128, 2, 12, 2, 4, 26, 12, 13, 21, 111'110, flags, 1},
      {"QT128C2X", 3, 2, 128, 2, 12, 2, 3, 26, 12, 13, 21, 111'110, flags, 1},
      // The first three distances of an OT128 are codes, such as "too close".
      {"Pandar128", 1, 4, 128, 2, 12, 2, 3, 26, 12, 13, 21, 55'556, flags, 4},
      {"Pandar128", 1, 4, 128, 2, 12, 2, 4, 26, 12, 13, 21, 55'556, flags, 4},
      {"AT128", 4, 3, 128, 2, 12, 3, 4, 32, 24, 18, 20, 41'666, flags, 1, false, 4, true},
      {"Pandar64", 0, 0, 64, 6, 8, 2, 3, 22, 14, 8, 10, 55'560, sequence, 1},
      {"Pandar40", 0, 0, 40, 10, 0, 4, 3, 22, 14, 8, 10, 55'560, sequence, 1},
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
  // The times of these models depend on their settings and directions. They are at most 15 us (AT128), 56 us
  // (Pandar128) and 101 us (QT128).
  if (model.channels == 128) return times;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i);
    if (model.header == 12 && model.channels == 64) {
      times[i] = kPandarQtFiring[i];
    } else if (model.channels == 40 || model.channels == 64) {
      times[i] = model.firing_ns - (model.channels == 40 ? kPandar40Firing : kPandar64Firing)[i];
    } else if (model.blocks == 6) {  // an XT-32M2X fires two channels at once
      times[i] = 6'000 + 2'888 * (number % 16);
    } else {
      times[i] = 6'000 + (model.channels == 32 ? 1'512 : 3'024) * number;
    }
  }
  return times;
}

}  // namespace pcl_bv::detail
