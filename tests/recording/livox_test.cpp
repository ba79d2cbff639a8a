// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "captured_sweeps.h"
#include "made_livox.h"
#include "made_ouster.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/recording/packet_reader.h"
#include "sensor_family.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint64_t kStart = 1'700'000'000'000'000'000;  // a multiple of 100 ms

class Livox : public CapturedSweeps {};

// The coordinates by the protocol's definitions, in metres.
std::array<double, 3> point_of(unsigned type, const MadeLivoxPoint& p) {
  const auto a = static_cast<double>(p.a), b = static_cast<double>(p.b), c = static_cast<double>(p.c);
  if (type == 1) return {a / 1000, b / 1000, c / 1000};
  if (type == 2) return {a / 100, b / 100, c / 100};
  const double zenith = b / 18'000 * std::numbers::pi, azimuth = c / 18'000 * std::numbers::pi;
  return {a / 1000 * std::sin(zenith) * std::cos(azimuth), a / 1000 * std::sin(zenith) * std::sin(azimuth),
          a / 1000 * std::cos(zenith)};
}

// Equal; in spherical coordinates both are rounded to float, so the last bit may differ, or 1e-12 m near 0.
bool is_same(unsigned type, float got, double expected) {
  const auto rounded = static_cast<float>(expected);
  if (type != 3) return got == rounded;
  return got == rounded || std::nextafter(rounded, got) == got || std::abs(got - expected) <= 1e-12;
}

// Compares all points of a sweep with the packets, which are in the order of their times.
void expect_sweep(const SensorSweep& sweep, const std::vector<MadeLivoxPacket>& packets) {
  std::size_t at = 0;
  for (const MadeLivoxPacket& packet : packets) {
    const std::uint64_t last = std::max<std::uint64_t>(packet.points.size() - 1, 1);
    for (std::size_t i = 0; i < packet.points.size(); ++i) {
      const MadeLivoxPoint& made = packet.points[i];
      if (made.a == 0 && (packet.type == 3 || (made.b == 0 && made.c == 0))) continue;
      ASSERT_LT(at, sweep.points.size());
      const SensorPoint& got = sweep.points[at++];
      const std::array<double, 3> expected = point_of(packet.type, made);
      EXPECT_TRUE(is_same(packet.type, got.x, expected[0]) && is_same(packet.type, got.y, expected[1]) &&
                  is_same(packet.type, got.z, expected[2]))
          << got.x << ' ' << got.y << ' ' << got.z << ", point " << i;
      EXPECT_EQ(got.intensity, static_cast<float>(made.reflectivity));
      EXPECT_EQ(got.ring, static_cast<unsigned>(made.a) % 64);  // the tag
      EXPECT_EQ(got.time_ns,
                packet.timestamp - packets[0].timestamp + std::uint64_t{100} * packet.interval * i / last);
    }
  }
  EXPECT_EQ(at, sweep.points.size());
}

// Four frames of ten packets each.
std::vector<MadeLivoxPacket> four_frames(unsigned type = 1, std::uint64_t start = kStart) {
  std::vector<MadeLivoxPacket> packets;
  for (unsigned i = 0; i < 40; ++i)
    packets.push_back(random_livox(type, start + 10'000'000 * i + 70'000, 50 + i, 20));
  return packets;
}

std::vector<std::string> bytes_of_all(const std::vector<MadeLivoxPacket>& packets) {
  std::vector<std::string> all;
  for (const MadeLivoxPacket& packet : packets)
    all.push_back(livox_packet(packet));
  return all;
}

TEST_F(Livox, PointsOfEachDataTypeFollowTheProtocol) {
  for (const unsigned type : {1U, 2U, 3U}) {
    constexpr unsigned seed = 5;
    SCOPED_TRACE(testing::Message() << type << ", seed " << seed);
    const std::vector<MadeLivoxPacket> packets{random_livox(type, kStart, seed),
                                               random_livox(type, kStart + 99'999'999, seed + 1),
                                               random_livox(type, kStart + 100'000'000, seed + 2, 1),
                                               random_livox(type, kStart + 150'000'000, seed)};
    const auto sweeps = sweeps_of(pcap(bytes_of_all(packets)));
    ASSERT_EQ(sweeps.size(), 2U);
    EXPECT_THAT(warnings_, testing::IsEmpty());
    EXPECT_EQ(sweeps[0].stamp_ns, 100'000'000'000);
    EXPECT_EQ(sweeps[1].stamp_ns, 100'000'000'000 + 2 * 1'327'000);
    expect_sweep(sweeps[0], {packets[0], packets[1]});
    expect_sweep(sweeps[1], {packets[2], packets[3]});
  }
}

TEST_F(Livox, PacketsHaveTheSizesOfTheProtocol) {
  EXPECT_EQ(livox_packet(random_livox(1, 0, 1)).size(), 36U + 96 * 14);
  EXPECT_EQ(livox_packet(random_livox(2, 0, 1)).size(), 36U + 96 * 8);
  EXPECT_EQ(livox_packet(random_livox(3, 0, 1)).size(), 36U + 96 * 10);
  EXPECT_EQ(livox_crc("123456789"), 0xCBF43926U);  // the check value of CRC-32
}

TEST_F(Livox, CloudsHaveTimesAndTagsButNoRing) {
  const auto sweeps = sweeps_of(pcap({livox_packet(random_livox(1, kStart, 1))}));
  ASSERT_EQ(sweeps.size(), 1U);
  EXPECT_EQ(model_, "Livox");
  EXPECT_EQ(sweeps[0].frame_id, "livox_frame");
  const RawCloud cloud = raw_cloud_of(sweeps[0]);
  ASSERT_EQ(cloud.size(), sweeps[0].points.size());
  ASSERT_EQ(cloud.fields.size(), 6U);
  EXPECT_EQ(cloud.point_step, 24U);
  EXPECT_EQ(integers_of(cloud, "tag")[20], sweeps[0].points[20].ring);
  EXPECT_EQ(integers_of(cloud, "time_ns")[20], sweeps[0].points[20].time_ns);
  EXPECT_EQ(load_point(cloud.xyz(), 20).z, sweeps[0].points[20].z);
}

TEST_F(Livox, PacketsThatComeLateOrTwiceGoToTheirFrameOnce) {
  const std::vector<std::string> packets = bytes_of_all(four_frames());
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

TEST_F(Livox, LostPacketsLeaveTheOthersInTheirFrames) {
  std::vector<MadeLivoxPacket> packets = four_frames();
  packets.erase(packets.begin() + 8, packets.begin() + 13);
  const auto sweeps = sweeps_of(pcap(bytes_of_all(packets)));
  ASSERT_EQ(sweeps.size(), 4U);
  expect_sweep(sweeps[0], {packets.begin(), packets.begin() + 8});
  expect_sweep(sweeps[1], {packets.begin() + 8, packets.begin() + 15});
}

TEST_F(Livox, AStampMovesBackToAPacketThatWasMeasuredEarlier) {
  const auto sweeps = sweeps_of(
      pcap({livox_packet(random_livox(1, kStart + 480'000, 1)), livox_packet(random_livox(1, kStart, 2))}));
  ASSERT_EQ(sweeps.size(), 1U);
  EXPECT_EQ(sweeps[0].stamp_ns, 100'000'000'000 - 480'000);
  EXPECT_GE(sweeps[0].points.front().time_ns, 480'000U);
  EXPECT_LT(sweeps[0].points.back().time_ns, 480'000U);
}

TEST_F(Livox, PacketsThatComeAfterTheirFrameAreDroppedAndCounted) {
  std::vector<std::string> packets = bytes_of_all(four_frames());
  const auto expected = points_in(sweeps_of(pcap(packets)));
  packets.insert(packets.begin() + 35, {packets[0], packets[11]});
  EXPECT_EQ(points_in(sweeps_of(pcap(packets))), expected);
  EXPECT_THAT(warnings_, testing::ElementsAre("dropped 2 Livox packets that came after their frame"));
}

TEST_F(Livox, AClockThatStartsAnewGivesFrames) {
  std::vector<std::string> packets = bytes_of_all(four_frames());
  for (const std::string& packet : bytes_of_all(four_frames(1, 0)))
    packets.push_back(packet);
  const auto sweeps = sweeps_of(pcap(packets));
  ASSERT_EQ(sweeps.size(), 8U);
  EXPECT_EQ(points_in({sweeps[7]}), points_in({sweeps[3]}));
}

TEST_F(Livox, DamagedPacketsAreDroppedIfTheSensorHasChecksums) {
  std::vector<std::string> packets = bytes_of_all(four_frames());
  const auto expected = points_in(sweeps_of(pcap(packets)));
  std::vector<std::string> damaged = packets;
  for (std::size_t byte = 28; byte < damaged[3].size(); byte += 50)
    damaged.insert(damaged.begin() + 4, packets[3])->at(byte) ^= 1;
  EXPECT_EQ(points_in(sweeps_of(pcap(damaged))), expected);
  EXPECT_THAT(warnings_, testing::ElementsAre("dropped 6 Livox packets with a wrong checksum"));
  for (std::string& packet : packets)
    packet.replace(24, 4, std::string(4, '\0'));
  EXPECT_EQ(points_in(sweeps_of(pcap(packets))), expected);
  EXPECT_THAT(warnings_, testing::IsEmpty());
}

TEST_F(Livox, FramesHaveALimitedNumberOfPoints) {
  std::vector<std::string> packets;
  for (unsigned i = 0; i < 200; ++i)
    packets.push_back(livox_packet({2, kStart + i, 1, std::vector<MadeLivoxPoint>(6'000, {1, 2, 3, 4})}));
  const auto sweeps = sweeps_of(pcap(packets));
  ASSERT_EQ(sweeps.size(), 1U);
  EXPECT_EQ(sweeps[0].points.size(), 174U * 6'000);
  EXPECT_THAT(warnings_,
              testing::ElementsAre("dropped 26 Livox packets of frames with more than 1048576 points"));
}

TEST_F(Livox, PacketsWithoutPointsAreNoneOfItsPackets) {
  const auto family = open_livox({});
  const auto is_livox = [&](const std::string& bytes) {
    const Payload packet{0, reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
    return family->model_of(packet).has_value();
  };
  const std::string good = livox_packet(random_livox(1, kStart, 1));
  EXPECT_TRUE(is_livox(good));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(is_livox(good.substr(0, size))) << size;
  EXPECT_FALSE(is_livox(good + '\0'));
  for (const std::size_t field : {0U, 1U, 2U, 5U, 6U, 10U, 11U}) {
    std::string changed = good;
    changed[field] = static_cast<char>(changed[field] ^ 0x44);
    EXPECT_FALSE(is_livox(changed)) << field;
  }
  EXPECT_FALSE(is_livox(livox_packet({1, kStart, 0, {}})));
}

TEST_F(Livox, PacketsOfOtherSensorsAreNoneOfItsPackets) {
  const auto family = open_livox({});
  const auto is_livox = [&](const std::string& bytes) {
    const Payload packet{0, reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
    return family->model_of(packet).has_value() || !family->undecodable(packet).empty();
  };
  for (const unsigned mode : {0x37U, 0x39U})
    EXPECT_FALSE(is_livox(packet(0, 20, static_cast<std::uint8_t>(mode), 0x22)));
  for (const char* profile : {"LEGACY", "RNG19_RFL8_SIG16_NIR16", "RNG15_RFL8_NIR8"}) {
    const MadeOuster s = made_ouster(profile, 32);
    for (const std::string& one : packets_of_frame(s, 0, random_columns(s, 0, 1)))
      EXPECT_FALSE(is_livox(one));
  }
  constexpr unsigned seed = 9;
  std::mt19937 random(seed);
  for (unsigned i = 0; i < 20'000; ++i) {
    std::string bytes(random() % 1'500, '\0');
    for (char& byte : bytes)
      byte = static_cast<char>(random());
    EXPECT_FALSE(is_livox(bytes)) << i << ", seed " << seed;
  }
}

TEST_F(Livox, OtherDataTypesAreNamedAndThoseOfTheInertialSensorIgnored) {
  const std::string good = livox_packet(random_livox(1, kStart, 1));
  std::string inertial = livox_packet({0, kStart, 0, {{}, {}}});
  std::string other = good;
  other[10] = 17;
  EXPECT_EQ(sweeps_of(pcap({good, inertial, other})).size(), 1U);
  EXPECT_THAT(warnings_,
              testing::ElementsAre(testing::StartsWith("cannot decode Livox' data type 17 from ")));
}

TEST_F(Livox, CutAnywhereIsReadUpToItsLastWholePacket) {
  std::vector<std::string> packets;
  for (unsigned i = 0; i < 4; ++i)
    packets.push_back(livox_packet({1, kStart + i, 10, std::vector<MadeLivoxPoint>(3, {1, 2, 3, 4})}));
  const std::string whole = pcap(packets);
  const std::size_t record = (whole.size() - 24) / 4;
  for (std::size_t size = 1; size < whole.size(); ++size) {
    try {
      const auto sweeps = sweeps_of(whole.substr(0, size));
      ASSERT_EQ(sweeps.size(), 1U) << size;
      EXPECT_EQ(sweeps[0].points.size(), 3 * ((size - 24) / record));
    } catch (const IoError&) {
      EXPECT_LT(size, 24 + record);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
