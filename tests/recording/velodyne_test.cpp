// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/velodyne.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "made_packets.h"
#include "pcl_bv/io/io_error.h"
#include "recording_files.h"

namespace pcl_bv {
namespace {

std::string block(unsigned type, const std::string& body, bool big) {
  const std::string padded = body + std::string((4 - body.size() % 4) % 4, '\0');
  const std::string length = bytes_of(12 + padded.size(), 4, big);
  return bytes_of(type, 4, big) + length + padded + length;
}

std::string pcapng(const std::vector<std::string>& payloads, bool big) {
  std::string file =
      block(0x0A0D0D0A,
            bytes_of(0x1A2B3C4D, 4, big) + bytes_of(1, 2, big) + bytes_of(0, 2) + std::string(8, '\xFF'),
            big) +
      block(1,
            bytes_of(1, 2, big) + bytes_of(0, 6) + bytes_of(9, 2, big) + bytes_of(1, 2, big) +
                bytes_of(9, 1) + std::string(3, '\0') + bytes_of(0, 4),
            big) +
      block(5, "statistics", big);
  std::uint64_t time = 100'000'000'000;
  for (const std::string& payload : payloads) {
    const std::string frame = linked(1, udp(payload));
    file += block(6,
                  bytes_of(0, 4) + bytes_of(time >> 32U, 4, big) + bytes_of(time & 0xFFFFFFFFU, 4, big) +
                      bytes_of(frame.size(), 4, big) + bytes_of(frame.size(), 4, big) + frame,
                  big);
    time += 1'327'000;
  }
  return file;
}

class Velodyne : public RecordingFiles {
 protected:
  std::vector<VelodyneSweep> sweeps_of(const std::string& file) {
    put("a.pcap", file);
    VelodyneReader reader(at("a.pcap"));
    std::vector<VelodyneSweep> sweeps;
    for (VelodyneSweep sweep; reader.next(sweep);)
      sweeps.push_back(sweep);
    return sweeps;
  }
};

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
      const VelodynePoint& p = sweeps[0].points[i];
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
  EXPECT_THROW(VelodyneReader(at("a.pcap")), IoError);
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
        VelodyneReader reader(at("b.pcap"));
        VelodyneSweep sweep;
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
}  // namespace pcl_bv
