// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "captured_sweeps.h"
#include "pcl_bv/recording/packet_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "made_packets.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

class Velodyne : public CapturedSweeps {};

TEST_F(Velodyne, OfEachModelHasItsBeamsWhereItsManualSays) {
  struct Case {
    std::uint8_t factory;
    double metres, lowest, highest;
    std::size_t beams;
  };
  for (const Case& c : {Case{0x22, 0.002, -15, 15, 16}, Case{0x21, 0.002, -30.67, 10.67, 32},
                        Case{0x28, 0.004, -25, 15, 32}}) {
    const auto sweeps = sweeps_of(pcap({packet(9000, 40, 0x37, c.factory)}));
    ASSERT_EQ(sweeps.size(), 1U);
    ASSERT_EQ(sweeps[0].points.size(), 12U * 32);
    EXPECT_EQ(sweeps[0].stamp_ns, 100'000'000'000);
    for (std::size_t i = 0; i < 32; ++i) {
      const SensorPoint& p = sweeps[0].points[i];
      const double distance = std::hypot(p.x, p.y, p.z),
                   up = std::asin(p.z / distance) * 180 / 3.14159265358979;
      EXPECT_NEAR(distance, c.metres * static_cast<double>(1000 + i), 1e-5);
      EXPECT_EQ(p.intensity, static_cast<float>(i));
      if (p.ring == 0) {
        EXPECT_NEAR(up, c.lowest, 1e-3);
      } else if (p.ring == c.beams - 1) {
        EXPECT_NEAR(up, c.highest, 1e-3);
      }
      EXPECT_GT(p.x, 1);  // at 90 degrees
      EXPECT_LT(std::abs(p.y), 0.4);
    }
  }
}

TEST_F(Velodyne, EndsASweepWhereTheAzimuthWraps) {
  std::vector<std::string> payloads;
  for (unsigned azimuth = 35'000; azimuth < 35'000 + 72'000; azimuth += 480)
    payloads.push_back(packet(azimuth % 36'000, 40, 0x37, 0x22));
  const auto sweeps = sweeps_of(pcap(payloads));
  ASSERT_EQ(sweeps.size(), 3U);  // what was there of the first, a whole one, and of the last
  EXPECT_NEAR(static_cast<double>(sweeps[1].points.size()), 900 * 32, 64);
  EXPECT_LT(sweeps[0].points.size(), 1000U);
  EXPECT_GT(sweeps[1].stamp_ns, sweeps[0].stamp_ns);
  for (std::size_t i = 1; i < sweeps[1].points.size(); ++i)
    EXPECT_LE(sweeps[1].points[i].time_ns, 105'000'000U);
}

// Three turns at 10 Hz from 0 on.
std::vector<std::string> three_turns(std::uint8_t factory = 0x22, std::uint8_t mode = 0x37,
                                     unsigned from = 0) {
  std::vector<std::string> payloads;
  for (unsigned azimuth = 0; azimuth < 3 * 36'000; azimuth += mode == 0x39 ? 240 : 480)
    payloads.push_back(packet((azimuth + from) % 36'000, 40, mode, factory));
  return payloads;
}

std::vector<std::size_t> sizes_of(const std::vector<SensorSweep>& sweeps) {
  std::vector<std::size_t> sizes;
  for (const SensorSweep& sweep : sweeps)
    sizes.push_back(sweep.points.size());
  return sizes;
}

TEST_F(Velodyne, PacketsThatComeLateOrTwiceEndNoTurn) {
  for (const std::uint8_t factory : std::vector<std::uint8_t>{0x22, 0x21, 0x28}) {
    for (const std::uint8_t mode : std::vector<std::uint8_t>{0x37, 0x39}) {
      const std::vector<std::string> payloads = three_turns(factory, mode);
      const std::vector<std::size_t> expected = sizes_of(sweeps_of(pcap(payloads)));
      ASSERT_EQ(expected.size(), 3U);
      // Every place, so also where the azimuth wraps.
      for (std::size_t i = 1; i + 2 < payloads.size(); i += i % 75 > 70 || i % 75 < 4 ? 1 : 23) {
        SCOPED_TRACE(testing::Message() << int{factory} << ' ' << int{mode} << ' ' << i);
        std::vector<std::string> swapped = payloads;
        std::swap(swapped[i], swapped[i + 1]);
        EXPECT_EQ(sizes_of(sweeps_of(pcap(swapped))), expected);
        std::vector<std::string> twice = payloads;
        twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(i + 1), payloads[i]);
        const auto sweeps = sweeps_of(pcap(twice));
        ASSERT_EQ(sweeps.size(), 3U);
        std::size_t all = 0;
        for (const SensorSweep& sweep : sweeps)
          all += sweep.points.size();
        EXPECT_EQ(all, expected[0] + expected[1] + expected[2] + (mode == 0x39 ? 6 : 12) * 32U);
      }
    }
  }
}

TEST_F(Velodyne, LostPacketsDoNotJoinTurns) {
  const std::vector<std::string> payloads = three_turns();
  for (std::size_t lost = 1; lost < 70; lost += 7) {
    std::vector<std::string> rest = payloads;
    std::string file = pcap(payloads);
    // Cut out of the file, so that the times of the others stay; the azimuth wraps in the middle of them.
    const std::size_t record = (file.size() - 24) / payloads.size();
    file.erase(24 + record * (75 - lost / 2), record * lost);
    const auto sweeps = sweeps_of(file);
    ASSERT_EQ(sweeps.size(), 3U) << lost;
    EXPECT_EQ(sweeps[2].points.size(), 75U * 12 * 32);
  }
}

TEST_F(Velodyne, ThatTurnsTheOtherWayHasTurns) {
  std::vector<std::string> payloads;
  for (int azimuth = 3 * 36'000 - 1; azimuth > 0; azimuth -= 480) {
    std::string one = packet(0, 40, 0x37, 0x21);
    for (int block = 0; block < 12; ++block)
      one.replace(static_cast<std::size_t>(100 * block + 2), 2,
                  pcl_bv::bytes_of(static_cast<std::uint64_t>((azimuth + 36'000 - 40 * block) % 36'000), 2));
    payloads.push_back(one);
  }
  const auto sweeps = sweeps_of(pcap(payloads));
  ASSERT_EQ(sweeps.size(), 3U);
  EXPECT_EQ(sweeps[1].points.size(), 900U * 32);
}

TEST_F(Velodyne, OfSeveralSensorsGivesTheTurnsOfEach) {
  const std::vector<std::string> one = three_turns();
  for (const unsigned apart : {18'000U, 9'000U, 100U}) {
    for (const bool same_address : {false, true}) {
      if (same_address && apart < 9'000) continue;  // nothing tells them apart
      const std::vector<std::string> other = three_turns(0x22, 0x37, apart);
      std::vector<std::pair<std::uint8_t, std::string>> both;
      for (std::size_t i = 0; i < one.size(); ++i) {
        both.emplace_back(201, one[i]);
        both.emplace_back(same_address ? 201 : 202, other[i]);
      }
      put("a.pcap", pcap_of(both));
      PacketReader reader(at("a.pcap"));
      std::size_t sweeps[2] = {}, points = 0;
      for (SensorSweep sweep; reader.next(sweep);) {
        ASSERT_LT(sweep.sensor, 2U);
        ++sweeps[sweep.sensor];
        points += sweep.points.size();
      }
      EXPECT_EQ(sweeps[0], 3U) << apart << same_address;
      EXPECT_EQ(sweeps[1], 4U) << apart << same_address;
      EXPECT_EQ(points, 2 * one.size() * 12 * 32);
      ASSERT_EQ(reader.warning_lines().size(), 1U);
      EXPECT_THAT(reader.warning_lines()[0], testing::StartsWith("packets of 2 sensors (192.168.1.201:2368"));
    }
  }
}

TEST_F(Velodyne, OneOfSeveralSensorsIsChosenByItsAddress) {
  const std::vector<std::string> one = three_turns();
  std::vector<std::pair<std::uint8_t, std::string>> both;
  for (const std::string& payload : one) {
    both.emplace_back(201, payload);
    both.emplace_back(202, payload);
  }
  put("a.pcap", pcap_of(both));
  PacketReader reader(at("a.pcap"), "192.168.1.202:2368");
  std::size_t sweeps = 0;
  for (SensorSweep sweep; reader.next(sweep);)
    ++sweeps;
  EXPECT_EQ(sweeps, 3U);
  EXPECT_THAT(reader.warning_lines(), testing::IsEmpty());
  try {
    PacketReader(at("a.pcap"), "192.168.1.203:2368");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "no packets of a sensor at 192.168.1.203:2368; there are 192.168.1.201:2368, 192.168.1.202:2368");
  }
}

TEST_F(Velodyne, SaysWhatElseACaptureHas) {
  const auto said = [&](const std::string& payload) {
    put("a.pcap", pcap({payload}));
    try {
      PacketReader(at("a.pcap"));
    } catch (const IoError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(said(std::string(1248, 'a')), testing::EndsWith("UDP packets: 1248 bytes from 0.0.0.0:2368"));
  EXPECT_THAT(said(packet(0, 40, 0x37, 0xA1)), testing::EndsWith("Velodyne's product 161 from 0.0.0.0:2368"));
}

TEST_F(Velodyne, GoesOnBehindADamagedPacket) {
  const std::vector<std::string> payloads = three_turns();
  for (const bool blocks : {false, true}) {
    std::string file = blocks ? pcapng(payloads, false) : pcap(payloads);
    const std::size_t record = (file.size() - (blocks ? 0 : 24)) / payloads.size();
    for (std::size_t i = 0; i < 40; ++i)  // headers among them
      file[file.size() - 100 * record - 20 + i] = '\xFE';
    put("a.pcap", file);
    PacketReader reader(at("a.pcap"));
    std::size_t points = 0, sweeps = 0;
    for (SensorSweep sweep; reader.next(sweep); ++sweeps)
      points += sweep.points.size();
    EXPECT_EQ(sweeps, 3U) << blocks;
    EXPECT_GE(points, (payloads.size() - 3) * 12 * 32) << blocks;
    EXPECT_THAT(reader.warning_lines(), testing::Contains(testing::StartsWith("skipped damaged bytes ")))
        << blocks;
  }
}

TEST_F(Velodyne, OfDualReturnsHasBothUnlessTheyAreOne) {
  EXPECT_EQ(sweeps_of(pcap({packet(100, 40, 0x39, 0x22, 0)}))[0].points.size(), 6U * 32);
  EXPECT_EQ(sweeps_of(pcap({packet(100, 40, 0x39, 0x22, 500)}))[0].points.size(), 12U * 32);
  EXPECT_EQ(sweeps_of(pcap({packet(100, 40, 0x38, 0x22)}))[0].points.size(), 12U * 32);
}

TEST_F(Velodyne, IsReadFromEveryLinkAndByteOrder) {
  const std::vector<std::string> payloads = {packet(100, 40, 0x37, 0x22), packet(600, 40, 0x37, 0x22)};
  const auto expected = sweeps_of(pcap(payloads));
  const auto expect_same = [&](const std::string& file) {
    const auto sweeps = sweeps_of(file);
    ASSERT_EQ(sweeps.size(), 1U);
    EXPECT_EQ(sweeps[0].stamp_ns, expected[0].stamp_ns);
    ASSERT_EQ(sweeps[0].points.size(), expected[0].points.size());
    EXPECT_EQ(sweeps[0].points.back().time_ns, expected[0].points.back().time_ns);
    EXPECT_EQ(sweeps[0].points.back().x, expected[0].points.back().x);
  };
  for (const unsigned link : {0U, 1U, 101U, 113U, 276U, 10'001U}) {
    SCOPED_TRACE(link);
    for (const bool big : {false, true}) {
      for (const bool nano : {false, true})
        expect_same(pcap(payloads, link, big, nano));
    }
  }
  for (const bool big : {false, true})
    expect_same(pcapng(payloads, big));
}

TEST_F(Velodyne, PassesOverWhatIsNoPacketOfIts) {
  const std::string good = packet(100, 40, 0x37, 0x22);
  std::string fragment = pcap({good, good});
  fragment[24 + 16 + 14 + 6] = 0x20;  // more fragments follow
  EXPECT_EQ(sweeps_of(fragment)[0].points.size(), 12U * 32);
  EXPECT_EQ(sweeps_of(pcap({"position", good}))[0].points.size(), 12U * 32);
  put("a.pcap", pcap({"position"}));
  EXPECT_THROW(PacketReader(at("a.pcap")), IoError);
  EXPECT_FALSE(is_capture(at("none")));
  put("text", "no capture");
  EXPECT_FALSE(is_capture(at("text")));
}

TEST_F(Velodyne, CutAnywhereIsReadUpToItsLastWholePacket) {
  for (const bool blocks : {false, true}) {
    const std::vector<std::string> payloads = {packet(100, 40, 0x37, 0x22), packet(600, 40, 0x37, 0x22)};
    const std::string whole = blocks ? pcapng(payloads, false) : pcap(payloads);
    for (std::size_t size = 1; size < whole.size(); size += 7) {
      put("b.pcap", whole.substr(0, size));
      try {
        PacketReader reader(at("b.pcap"));
        SensorSweep sweep;
        ASSERT_TRUE(reader.next(sweep)) << size;
        EXPECT_EQ(sweep.points.size(), 12U * 32) << size;
        EXPECT_FALSE(reader.next(sweep));
      } catch (const IoError&) {
        EXPECT_LT(size, whole.size() / 2 + 150);
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
