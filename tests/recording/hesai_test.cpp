// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "captured_sweeps.h"
#include "made_hesai.h"
#include "pcl_bv/recording/packet_reader.h"

namespace pcl_bv::detail {
namespace {

// Times from the firing of a channel to the end of the firing sequence in the tables of the manuals,
// microseconds; channels 1, 4, 8 and the last one.
constexpr std::array kPandar64Times{23.18, 19.268, 46.796, 12.748};
constexpr std::array kPandar40Times{42.22, 3.62, 54.67, 3.62};

class Hesai : public CapturedSweeps {};

std::vector<std::string> bytes_of_all(const MadeHesai& s, const std::vector<MadeHesaiPacket>& packets) {
  std::vector<std::string> all;
  for (const MadeHesaiPacket& packet : packets)
    all.push_back(hesai_bytes(s, packet));
  return all;
}

// The point of a return by the manual: the azimuth is that of the rotor and of the channel, clockwise.
std::array<double, 3> point_of(unsigned distance, double rotor, std::pair<int, int> channel) {
  constexpr double degree = std::numbers::pi / 180;
  const double elevation = channel.first / 1000.0 * degree,
               azimuth = (rotor / 100 + channel.second / 1000.0) * degree;
  const double metres = distance * 0.004, level = metres * std::cos(elevation);
  return {level * std::sin(azimuth), level * std::cos(azimuth), metres * std::sin(elevation)};
}

// Time of a channel after the beginning of its firing, nanoseconds; -1 where no table is at hand.
double firing_ns(const MadeHesai& s, std::size_t channel) {
  if (s.channels == 32) return 6'000 + 1'512.0 * static_cast<double>(channel);
  if (s.channels == 16) return 6'000 + 3'024.0 * static_cast<double>(channel);
  const std::size_t row = channel == 0                ? 0
                          : channel == 3              ? 1
                          : channel == 7              ? 2
                          : channel + 1 == s.channels ? 3
                                                      : 4;
  if (row == 4) return -1;
  return 55'560 - 1'000 * (s.channels == 64 ? kPandar64Times : kPandar40Times)[row];
}

// Compares all points of a sweep with the firings from `first` to before `last`, counted over all packets.
void expect_sweep(const SensorSweep& sweep, const MadeHesai& s, const std::vector<MadeHesaiPacket>& packets,
                  std::size_t first, std::size_t last, const std::vector<std::pair<int, int>>& angles) {
  std::size_t at = 0;
  for (std::size_t i = first; i < last; ++i) {
    const auto time_us = [&](std::size_t firing) {
      const double packet_us = packets[firing / s.firings()].microseconds;
      return packet_us + static_cast<double>(firing % s.firings()) * s.period_us();
    };
    const double since_ns = std::fmod(time_us(i) - time_us(first) + 1e6, 1e6) * 1000;
    const MadeHesaiPacket& packet = packets[i / s.firings()];
    const unsigned rotor = firing_azimuth(s, packet.azimuth, i % s.firings());
    for (std::size_t channel = 0; channel < s.channels; ++channel) {
      const auto& returns = packet.firings[i % s.firings()][channel];
      for (std::size_t which = 0; which < (s.dual ? 2U : 1U); ++which) {
        const auto& [distance, reflectivity] = returns[which];
        if (distance == 0 || (which == 1 && returns[0] == returns[1])) continue;
        ASSERT_LT(at, sweep.points.size());
        const SensorPoint& got = sweep.points[at++];
        const std::array<double, 3> expected = point_of(distance, rotor, angles[channel]);
        ASSERT_TRUE(is_same_coordinate(got.x, expected[0]) && is_same_coordinate(got.y, expected[1]) &&
                    is_same_coordinate(got.z, expected[2]))
            << got.x << ' ' << got.y << ' ' << got.z << " for " << expected[0] << ' ' << expected[1];
        EXPECT_EQ(got.intensity, static_cast<float>(reflectivity));
        EXPECT_EQ(got.ring, channel);
        const double offset = firing_ns(s, channel);
        if (offset >= 0) {
          EXPECT_NEAR(got.time_ns, since_ns + offset, 0.5);
        }
      }
    }
  }
  EXPECT_EQ(at, sweep.points.size());
}

std::vector<std::pair<int, int>> design_angles(std::size_t channels) {
  std::vector<std::pair<int, int>> angles;
  for (int i = 0; i < static_cast<int>(channels); ++i)
    angles.emplace_back(15'000 - (channels == 32 ? 1'000 : 2'000) * i, 0);
  return angles;
}

TEST_F(Hesai, PointsOfEachModelFollowTheManuals) {
  constexpr unsigned seed = 21;
  for (const std::size_t channels : {16U, 32U, 40U, 64U}) {
    for (const bool dual : {false, true}) {
      for (const bool corrected : {false, true}) {
        if (!corrected && channels > 32) continue;
        SCOPED_TRACE(testing::Message() << channels << ' ' << dual << ' ' << corrected << ", seed " << seed);
        const MadeHesai s{channels, dual, corrected, 20};
        std::filesystem::remove(at("a.csv"));
        if (corrected) put("a.csv", hesai_correction(channels));
        const std::size_t firings = 4'000 / s.firings() * s.firings();
        const auto packets = hesai_packets(s, firings / s.firings(), 30'000, seed);
        const auto sweeps = sweeps_of(pcap(bytes_of_all(s, packets)));
        ASSERT_EQ(sweeps.size(), 4U);
        EXPECT_EQ(model_, channels <= 32 ? "PandarXT-" + std::to_string(channels)
                                         : "Pandar" + std::to_string(channels));
        EXPECT_THAT(warnings_, testing::IsEmpty());
        const auto angles = corrected ? hesai_angles(channels) : design_angles(channels);
        const std::size_t ends[] = {0, 300, 2'100, 3'900, firings};
        for (std::size_t i = 0; i < 4; ++i) {
          expect_sweep(sweeps[i], s, packets, ends[i], ends[i + 1], angles);
          EXPECT_EQ(sweeps[i].stamp_ns,
                    static_cast<std::int64_t>(100'000'000'000 + 1'327'000 * (ends[i] / s.firings())));
          EXPECT_EQ(sweeps[i].frame_id, "hesai_lidar");
        }
      }
    }
  }
}

TEST_F(Hesai, PacketsHaveTheSizesOfTheManuals) {
  const auto size = [](MadeHesai s) { return hesai_bytes(s, random_hesai(s, 0, 0, 1)).size(); };
  EXPECT_EQ(size({32}), 1'080U);
  EXPECT_EQ(size({16}), 568U);
  EXPECT_EQ(size({64, false, false}), 1'194U);
  EXPECT_EQ(size({64, true, true}), 1'198U);
  EXPECT_EQ(size({40, false, false}), 1'262U);
  EXPECT_EQ(size({40, true, true}), 1'266U);
}

TEST_F(Hesai, ARotationInTheOtherDirectionGivesTheSameRevolutions) {
  const MadeHesai s{16, false, true, -20};
  const auto packets = hesai_packets(s, 500, 5'990, 3);
  const auto sweeps = sweeps_of(pcap(bytes_of_all(s, packets)));
  ASSERT_EQ(sweeps.size(), 4U);
  expect_sweep(sweeps[0], s, packets, 0, 300, design_angles(16));
  expect_sweep(sweeps[1], s, packets, 300, 2'100, design_angles(16));
}

// Revolutions of 25 packets.
constexpr MadeHesai kCoarse{16, true, true, 360};

TEST_F(Hesai, PacketsThatComeLateOrTwiceGoToTheirRevolutionOnce) {
  const std::vector<std::string> packets = bytes_of_all(kCoarse, hesai_packets(kCoarse, 80, 28'000, 4));
  const auto expected = points_in(sweeps_of(pcap(packets)));
  ASSERT_EQ(expected.size(), 4U);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    SCOPED_TRACE(i);
    std::vector<std::string> changed = packets;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(std::min(i + 5, changed.size())),
                   packets[i]);
    EXPECT_EQ(points_in(sweeps_of(pcap(changed))), expected);
    if (i + 4 >= packets.size()) continue;
    changed = packets;  // four places late
    std::rotate(changed.begin() + static_cast<std::ptrdiff_t>(i),
                changed.begin() + static_cast<std::ptrdiff_t>(i + 1),
                changed.begin() + static_cast<std::ptrdiff_t>(i + 5));
    EXPECT_EQ(points_in(sweeps_of(pcap(changed))), expected);
    EXPECT_THAT(warnings_, testing::IsEmpty());
  }
}

TEST_F(Hesai, LostPacketsLeaveTheOthersInTheirRevolutions) {
  auto packets = hesai_packets(kCoarse, 80, 0, 4);
  packets.erase(packets.begin() + 20, packets.begin() + 32);
  const auto sweeps = sweeps_of(pcap(bytes_of_all(kCoarse, packets)));
  ASSERT_EQ(sweeps.size(), 4U);
  expect_sweep(sweeps[0], kCoarse, packets, 0, 80, design_angles(16));
  expect_sweep(sweeps[1], kCoarse, packets, 80, 152, design_angles(16));
}

TEST_F(Hesai, PacketsThatComeAfterTheirRevolutionAreDroppedAndCounted) {
  std::vector<std::string> packets = bytes_of_all(kCoarse, hesai_packets(kCoarse, 80, 0, 4));
  const auto expected = points_in(sweeps_of(pcap(packets)));
  packets.insert(packets.begin() + 65, {packets[0], packets[30]});
  EXPECT_EQ(points_in(sweeps_of(pcap(packets))), expected);
  EXPECT_THAT(warnings_, testing::ElementsAre("dropped 2 Hesai packets that came after their revolution"));
}

TEST_F(Hesai, APauseEndsTheRevolution) {
  std::vector<std::string> packets = bytes_of_all(kCoarse, hesai_packets(kCoarse, 10, 0, 4));
  packets.insert(packets.end(), 300, "another protocol");
  for (const std::string& packet : bytes_of_all(kCoarse, hesai_packets(kCoarse, 10, 9'000, 5)))
    packets.push_back(packet);
  EXPECT_EQ(sweeps_of(pcap(packets)).size(), 2U);
}

TEST_F(Hesai, RevolutionsHaveALimitedNumberOfPoints) {
  const MadeHesai s{64, true, false, 1};
  put("a.csv", hesai_correction(64));
  MadeHesaiPacket packet = random_hesai(s, 0, 0, 1);
  for (auto& firing : packet.firings)
    for (auto& returns : firing)
      returns = {MadeHesaiReturn{1, 1}, MadeHesaiReturn{2, 2}};
  std::vector<std::string> packets;
  for (; packet.microseconds < 2'800; ++packet.microseconds)
    packets.push_back(hesai_bytes(s, packet));
  const auto sweeps = sweeps_of(pcap(packets));
  ASSERT_EQ(sweeps.size(), 1U);
  EXPECT_EQ(sweeps[0].points.size(), 2'730U * 384);
  EXPECT_THAT(warnings_,
              testing::ElementsAre("dropped 70 Hesai packets of revolutions with more than 1048576 points"));
}

TEST_F(Hesai, CutAnywhereIsReadUpToItsLastWholePacket) {
  const MadeHesai s{16, false, true, 20};
  const std::string whole = pcap(bytes_of_all(s, hesai_packets(s, 2, 0, 1)));
  const std::size_t record = (whole.size() - 24) / 2;
  for (std::size_t size = 1; size < whole.size(); ++size) {
    try {
      const auto sweeps = sweeps_of(whole.substr(0, size));
      ASSERT_EQ(sweeps.size(), 1U) << size;
      EXPECT_GE(size, 24 + record);
      EXPECT_LE(sweeps[0].points.size(), 8 * 16 * ((size - 24) / record));
    } catch (const IoError&) {
      EXPECT_LT(size, 24 + record);
    }
  }
}

// A sensor that sends only the firings from 10 to 110 degrees. Most packets with a gap have firings of both
// sides.
TEST_F(Hesai, FiringsBehindTheGapOfALimitedFieldOfViewBeginASweep) {
  for (const int step : {18, -18}) {
    MadeHesai s;
    s.step = step;
    MadeHesaiPacket made;
    made.firings.assign(8, std::vector<std::array<MadeHesaiReturn, 2>>(32, {{{1'000, 7}, {1'000, 7}}}));
    std::vector<std::string> packets;
    std::vector<std::size_t> expected;
    std::size_t block = 0;
    unsigned last_passage = 99;
    for (unsigned i = 0; i < 4 * 2'000; ++i) {
      const unsigned turned = 18 * (i % 2'000), azimuth = step > 0 ? turned : (36'000 - turned) % 36'000;
      if (azimuth < 1'000 || azimuth > 11'000) continue;
      if (block == 0) {
        made.microseconds = 50 * i;
        packets.push_back(hesai_bytes(s, made));
      }
      packets.back().replace(12 + block * 130, 2, pcl_bv::bytes_of(azimuth, 2));
      block = (block + 1) % 8;
      if (std::exchange(last_passage, i / 2'000) != i / 2'000) expected.push_back(0);
      expected.back() += 32;
    }
    if (block > 0) {
      packets.pop_back();
      expected.back() -= 32 * block;
    }
    std::vector<std::size_t> sizes;
    for (const SensorSweep& sweep : sweeps_of(pcap(packets)))
      sizes.push_back(sweep.points.size());
    EXPECT_EQ(sizes, expected);
    EXPECT_THAT(warnings_, testing::IsEmpty());
  }
}

}  // namespace
}  // namespace pcl_bv::detail
