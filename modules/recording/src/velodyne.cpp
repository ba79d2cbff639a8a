// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/velodyne.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

#include "packet_file.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kPacket = 1206, kBlock = 100, kBlocks = 12, kLasers = 32;
constexpr double kDegree = 3.14159265358979323846 / 180;

// A sensor: of 32 returns of a block the beams in turn, and how far a firing takes.
struct Model {
  std::string_view name;
  std::uint8_t factory;  // the last byte of a packet
  std::size_t beams;
  double metres;                        // of a step of distance
  double block_ns, laser_ns;            // from a block to the next, from a laser (or pair) to the next
  std::array<double, kLasers> degrees;  // up, of each beam
  std::array<double, kLasers> aside;    // azimuth of each beam, degrees
};

constexpr Model kModels[] = {
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

// Azimuths are hundredths of a degree.
constexpr std::size_t kTurn = 36'000;
struct Turn {
  double sine, cosine;
};

const std::vector<Turn>& turns() {
  static const auto all = [] {
    std::vector<Turn> made(kTurn);
    for (std::size_t i = 0; i < kTurn; ++i) {
      const double angle = static_cast<double>(i) / 100 * kDegree;
      made[i] = {std::sin(angle), std::cos(angle)};
    }
    return made;
  }();
  return all;
}

std::uint16_t word(const std::byte* at) {
  std::uint16_t value;
  std::memcpy(&value, at, 2);
  return value;
}

const Model* model_of(const Payload& packet) {
  if (packet.size != kPacket || word(packet.data) != 0xEEFF) return nullptr;
  const auto factory = std::to_integer<std::uint8_t>(packet.data[kPacket - 1]);
  const auto* const found = std::find_if(std::begin(kModels), std::end(kModels),
                                         [&](const Model& model) { return model.factory == factory; });
  return found == std::end(kModels) ? nullptr : found;
}

}  // namespace

bool is_capture(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;
  char start[4] = {};
  std::ifstream(file, std::ios::binary).read(start, sizeof start);
  return is_packet_file({start, sizeof start});
}

struct VelodyneReader::State {
  explicit State(const std::filesystem::path& path) : file(path) {
    packets.emplace(file);
    const Model* found = nullptr;
    for (Payload packet; found == nullptr && packets->next(packet);)
      found = model_of(packet);
    if (found == nullptr) throw IoError("no packet of a VLP-16, HDL-32E or VLP-32C");
    model = found;
    std::array<double, kLasers> sorted = model->degrees;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(model->beams));
    for (std::size_t i = 0; i < model->beams; ++i) {
      ring[i] = static_cast<std::uint32_t>(std::find(sorted.begin(), sorted.end(), model->degrees[i]) -
                                           sorted.begin());
      sine[i] = std::sin(model->degrees[i] * kDegree);
      cosine[i] = std::cos(model->degrees[i] * kDegree);
      aside[i] = static_cast<std::size_t>(std::lround(100 * model->aside[i]) + static_cast<long>(kTurn));
    }
    rewind();
  }

  void rewind() {
    packets.emplace(file);
    sweep = VelodyneSweep();
    whole.clear();
    last_azimuth = 0;
  }

  // Adds a packet's returns; each sweep that ends goes to `whole`.
  void add(const Payload& packet) {
    const bool dual = std::to_integer<int>(packet.data[kPacket - 2]) == 0x39;
    const std::size_t step = dual ? 2 : 1;
    // The second firing of a block of a VLP-16 is half way to the next block, by this packet's first two.
    const int first = azimuth(packet, 0), second = azimuth(packet, step);
    const double half = (second < first ? second + 36'000 - first : second - first) / 2.0;
    for (std::size_t block = 0; block < kBlocks; block += step) {
      const std::size_t firing = block / step;
      for (std::size_t laser = 0; laser < kLasers; ++laser) {
        double at = azimuth(packet, block);
        if (laser >= model->beams) at += half;
        if (at > 36'000) at -= 36'000;
        if (at < last_azimuth) end_sweep();
        last_azimuth = at;
        if (sweep.points.empty()) sweep.stamp_ns = packet.time_ns;
        const double time = static_cast<double>(packet.time_ns - sweep.stamp_ns) +
                            static_cast<double>(firing) * model->block_ns +
                            static_cast<double>(laser) * model->laser_ns;
        const std::byte* const one = returned(packet, block, laser);
        add_point(one, laser, at, time);
        if (dual && std::memcmp(one, returned(packet, block + 1, laser), 3) != 0)
          add_point(returned(packet, block + 1, laser), laser, at, time);
      }
    }
  }

  void end_sweep() {
    if (!sweep.points.empty()) whole.push_back(std::move(sweep));
    sweep = VelodyneSweep();
  }

  static int azimuth(const Payload& packet, std::size_t block) {
    return word(packet.data + kBlock * block + 2);
  }
  static const std::byte* returned(const Payload& packet, std::size_t block, std::size_t laser) {
    return packet.data + kBlock * block + 4 + 3 * laser;
  }

  void add_point(const std::byte* at, std::size_t laser, double hundredths, double time) {
    const double distance = word(at) * model->metres;
    if (distance == 0) return;  // no return
    const std::size_t beam = laser % model->beams;
    const Turn& turn = turns()[(static_cast<std::size_t>(hundredths) + aside[beam]) % kTurn];
    const double level = distance * cosine[beam];
    sweep.points.push_back({static_cast<float>(level * turn.sine), static_cast<float>(level * turn.cosine),
                            static_cast<float>(distance * sine[beam]),
                            static_cast<float>(std::to_integer<int>(at[2])), ring[beam],
                            static_cast<std::uint32_t>(std::clamp(time, 0.0, 4e9))});
  }

  std::filesystem::path file;
  std::optional<PacketFile> packets;
  const Model* model = kModels;
  std::array<std::uint32_t, kLasers> ring{};
  std::array<double, kLasers> sine{}, cosine{};
  std::array<std::size_t, kLasers> aside{};  // hundredths of a degree, a turn more
  VelodyneSweep sweep;
  std::vector<VelodyneSweep> whole;
  double last_azimuth = 0;
};

VelodyneReader::VelodyneReader(const std::filesystem::path& file) : state_(std::make_unique<State>(file)) {}
VelodyneReader::~VelodyneReader() = default;

std::string_view VelodyneReader::model() const {
  return state_->model->name;
}

void VelodyneReader::rewind() {
  state_->rewind();
}

bool VelodyneReader::next(VelodyneSweep& sweep) {
  State& state = *state_;
  for (Payload packet; state.whole.empty() && state.packets->next(packet);) {
    const Model* const model = model_of(packet);
    if (model != nullptr && model == state.model) state.add(packet);
  }
  if (state.whole.empty()) state.end_sweep();
  if (state.whole.empty()) return false;
  sweep = std::move(state.whole.front());
  state.whole.erase(state.whole.begin());
  return true;
}

std::vector<std::string> VelodyneReader::remarks() const {
  return state_->packets->remarks();
}

}  // namespace pcl_bv
