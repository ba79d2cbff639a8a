// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "captured_sweeps.h"
#include "made_ouster.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/recording/packet_reader.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint64_t kStart = 1'700'000'000'000'000'000;
const std::vector<std::string> kProfiles{"LEGACY", "RNG19_RFL8_SIG16_NIR16", "RNG19_RFL8_SIG16_NIR16_DUAL",
                                         "RNG15_RFL8_NIR8"};

// The point of a return by the formulas of Ouster's manual, in metres.
std::array<double, 3> point_of(const MadeOuster& s, unsigned id, std::size_t beam, double range_mm) {
  const double encoder =
      2 * std::numbers::pi * (1 - static_cast<double>(id) / static_cast<double>(s.columns));
  const double azimuth = -2 * std::numbers::pi * s.azimuths[beam] / 360;
  const double altitude = 2 * std::numbers::pi * s.altitudes[beam] / 360;
  const double beyond = range_mm - std::hypot(s.beam_x, s.beam_z);
  const double lidar[4] = {
      beyond * std::cos(encoder + azimuth) * std::cos(altitude) + s.beam_x * std::cos(encoder),
      beyond * std::sin(encoder + azimuth) * std::cos(altitude) + s.beam_x * std::sin(encoder),
      beyond * std::sin(altitude) + s.beam_z, 1};
  std::array<double, 3> point{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < 4; ++i)
      point[row] += s.lidar_to_sensor[4 * row + i] * lidar[i] / 1000;
  }
  return point;
}

void expect_point(const SensorPoint& got, const MadeOuster& s, const MadeColumn& column, std::size_t beam,
                  const MadeReturn& made, std::uint64_t first_time) {
  const std::array<double, 3> expected = point_of(s, column.id, beam, made.range_mm);
  EXPECT_TRUE(is_same_coordinate(got.x, expected[0]) && is_same_coordinate(got.y, expected[1]) &&
              is_same_coordinate(got.z, expected[2]))
      << got.x << ' ' << got.y << ' ' << got.z << " for " << expected[0] << ' ' << expected[1] << ' '
      << expected[2];
  EXPECT_EQ(got.intensity, static_cast<float>(s.low_rate() ? made.reflectivity : made.signal));
  EXPECT_EQ(got.reflectivity, made.reflectivity);
  EXPECT_EQ(got.ring, beam);
  EXPECT_EQ(got.time_ns, column.timestamp - first_time);
}

bool is_same_return(const MadeReturn& a, const MadeReturn& b) {
  return a.range_mm == b.range_mm && a.reflectivity == b.reflectivity && a.signal == b.signal;
}

// Compares all points of a sweep with the columns, which are in the order of their packets.
void expect_sweep(const SensorSweep& sweep, const MadeOuster& s, const std::vector<MadeColumn>& columns) {
  std::size_t at = 0;
  for (const MadeColumn& column : columns) {
    for (std::size_t i = 0; i < s.beams; ++i) {
      const auto& [one, two] = column.beams[i];
      for (const MadeReturn* const made : {&one, &two}) {
        if (made->range_mm == 0 || (made == &two && is_same_return(one, two))) continue;
        ASSERT_LT(at, sweep.points.size());
        expect_point(sweep.points[at++], s, column, i, *made, columns[0].timestamp);
      }
    }
  }
  EXPECT_EQ(at, sweep.points.size());
}

class Ouster : public CapturedSweeps {};

TEST_F(Ouster, PointsOfEachProfileFollowTheManualsFormulas) {
  constexpr unsigned seed = 11;
  for (const std::string& profile : kProfiles) {
    for (const bool nested : {false, true}) {
      for (const std::size_t beams : {16U, 128U}) {
        SCOPED_TRACE(testing::Message() << profile << ' ' << nested << ' ' << beams << ", seed " << seed);
        MadeOuster s = made_ouster(profile, beams, beams == 128 ? 512 : 64);
        if (nested) {
          s.beam_z = -7.5;
          if (beams == 16) {
            s.lidar_to_sensor = {0.8, -0.6, 0, 10, 0.6, 0.8, 0, -20, 0, 0, 1, 38.195, 0, 0, 0, 1};
          } else {  // tilted
            s.lidar_to_sensor = {0.36, 0.48, -0.8, 10,     -0.8, 0.6, 0, -20,
                                 0.48, 0.64, 0.6,  38.195, 0,    0,   0, 1};
          }
        }
        put("a.json", nested ? nested_metadata(s) : flat_metadata(s));
        std::vector<std::string> packets;
        std::vector<std::vector<MadeColumn>> frames;
        for (unsigned frame = 0; frame < 3; ++frame) {
          frames.push_back(random_columns(s, kStart + 100'000'000 * frame, seed + frame));
          for (const std::string& packet : packets_of_frame(s, 65'534 + frame, frames.back()))
            packets.push_back(packet);
        }
        const auto sweeps = sweeps_of(pcap(packets));
        ASSERT_EQ(sweeps.size(), 3U);
        EXPECT_EQ(model_, std::string(nested ? "OS-0-" : "OS-1-") + std::to_string(beams));
        EXPECT_THAT(warnings_, testing::IsEmpty());
        for (std::size_t frame = 0; frame < 3; ++frame) {
          EXPECT_EQ(sweeps[frame].stamp_ns,
                    static_cast<std::int64_t>(100'000'000'000 + 1'327'000 * frame * packets.size() / 3));
          expect_sweep(sweeps[frame], s, frames[frame]);
        }
      }
    }
  }
}

TEST_F(Ouster, CloudsHaveTimeRingAndReflectivity) {
  const MadeOuster s = made_ouster("LEGACY");
  put("a.json", flat_metadata(s));
  const auto sweeps = sweeps_of(pcap(packets_of_frame(s, 0, random_columns(s, kStart, 1))));
  ASSERT_EQ(sweeps.size(), 1U);
  EXPECT_EQ(sweeps[0].frame_id, "os_sensor");
  const RawCloud cloud = raw_cloud_of(sweeps[0]);
  ASSERT_EQ(cloud.size(), sweeps[0].points.size());
  EXPECT_EQ(integers_of(cloud, "ring")[20], sweeps[0].points[20].ring);
  EXPECT_EQ(integers_of(cloud, "time_ns")[20], sweeps[0].points[20].time_ns);
  EXPECT_EQ(integers_of(cloud, "reflectivity")[20], sweeps[0].points[20].reflectivity);
  EXPECT_EQ(load_point(cloud.xyz(), 20).z, sweeps[0].points[20].z);
}

TEST_F(Ouster, DropsColumnsWithABadStatusAndToleratesMissingOnes) {
  for (const std::string& profile : kProfiles) {
    SCOPED_TRACE(profile);
    const MadeOuster s = made_ouster(profile);
    put("a.json", nested_metadata(s));
    std::vector<MadeColumn> columns = random_columns(s, kStart, 3);
    for (std::size_t i = 0; i < columns.size(); i += 5)
      columns[i].valid = i == 0;
    std::vector<std::string> packets = packets_of_frame(s, 7, columns);
    packets.erase(packets.begin() + 1);  // lost
    const auto sweeps = sweeps_of(pcap(packets));
    ASSERT_EQ(sweeps.size(), 1U);
    std::vector<MadeColumn> rest;
    for (const MadeColumn& column : columns) {
      if (column.valid && column.id / 16 != 1) rest.push_back(column);
    }
    expect_sweep(sweeps[0], s, rest);
  }
}

TEST_F(Ouster, IgnoresMeasurementIdsThatNoFrameHas) {
  const MadeOuster s = made_ouster("LEGACY");
  put("a.json", flat_metadata(s));
  std::vector<MadeColumn> columns = random_columns(s, kStart, 3);
  const std::vector<MadeColumn> rest(columns.begin(), columns.end() - 2);
  columns[62].id = 64;
  columns[63].id = 65'535;
  const auto sweeps = sweeps_of(pcap(packets_of_frame(s, 7, columns)));
  ASSERT_EQ(sweeps.size(), 1U);
  expect_sweep(sweeps[0], s, rest);
}

// Four frames of 10 packets each.
std::vector<std::string> four_frames(const MadeOuster& s, unsigned first = 65'534) {
  std::vector<std::string> packets;
  for (unsigned frame = 0; frame < 4; ++frame) {
    for (const std::string& packet :
         packets_of_frame(s, first + frame, random_columns(s, kStart + 100'000'000 * frame, 20 + frame)))
      packets.push_back(packet);
  }
  return packets;
}

TEST_F(Ouster, PacketsThatComeLateOrTwiceGoToTheirFrameOnce) {
  for (const std::string profile : {"LEGACY", "RNG15_RFL8_NIR8"}) {
    const MadeOuster s = made_ouster(profile, 16, 160);
    put("a.json", flat_metadata(s));
    const std::vector<std::string> packets = four_frames(s);
    ASSERT_EQ(packets.size(), 40U);
    const auto expected = points_in(sweeps_of(pcap(packets)));
    ASSERT_EQ(expected.size(), 4U);
    for (std::size_t i = 0; i < packets.size(); ++i) {
      SCOPED_TRACE(testing::Message() << profile << ' ' << i);
      std::vector<std::string> changed = packets;
      changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(std::min(i + 5, changed.size())),
                     packets[i]);
      EXPECT_EQ(points_in(sweeps_of(pcap(changed))), expected);
      if (i + 4 >= packets.size()) continue;
      changed = packets;  // five places late
      std::rotate(changed.begin() + static_cast<std::ptrdiff_t>(i),
                  changed.begin() + static_cast<std::ptrdiff_t>(i + 1),
                  changed.begin() + static_cast<std::ptrdiff_t>(i + 5));
      EXPECT_EQ(points_in(sweeps_of(pcap(changed))), expected);
      EXPECT_THAT(warnings_, testing::IsEmpty());
    }
  }
}

TEST_F(Ouster, AStampMovesBackToAColumnThatWasMeasuredEarlier) {
  const MadeOuster s = made_ouster("LEGACY");
  put("a.json", flat_metadata(s));
  std::vector<std::string> packets = packets_of_frame(s, 1, random_columns(s, kStart, 3));
  std::swap(packets[0], packets[1]);
  const auto sweeps = sweeps_of(pcap(packets));
  ASSERT_EQ(sweeps.size(), 1U);
  EXPECT_EQ(sweeps[0].stamp_ns, 100'000'000'000 - 16 * 97'656);
  EXPECT_EQ(sweeps[0].points.front().time_ns, 16 * 97'656U);
}

TEST_F(Ouster, PacketsThatComeAfterTheirFrameAreDroppedAndCounted) {
  const MadeOuster s = made_ouster("RNG19_RFL8_SIG16_NIR16", 16, 160);
  put("a.json", nested_metadata(s));
  std::vector<std::string> packets = four_frames(s);
  const auto expected = points_in(sweeps_of(pcap(packets)));
  packets.insert(packets.begin() + 35, {packets[0], packets[11]});
  EXPECT_EQ(points_in(sweeps_of(pcap(packets))), expected);
  EXPECT_THAT(warnings_, testing::ElementsAre("dropped 2 Ouster packets that came after their frame"));
}

TEST_F(Ouster, FrameIdsThatStartAnewGiveFrames) {
  const MadeOuster s = made_ouster("RNG19_RFL8_SIG16_NIR16", 16, 160);
  put("a.json", nested_metadata(s));
  std::vector<std::string> packets = four_frames(s, 900);
  for (const std::string& packet : four_frames(s, 100))
    packets.push_back(packet);
  const auto sweeps = sweeps_of(pcap(packets));
  ASSERT_EQ(sweeps.size(), 8U);
  EXPECT_EQ(points_in({sweeps[7]}), points_in({sweeps[3]}));
}

TEST_F(Ouster, PacketsInFragmentsGiveTheSamePoints) {
  MadeOuster s = made_ouster("RNG19_RFL8_SIG16_NIR16_DUAL", 128, 512);
  put("a.json", nested_metadata(s));
  const std::vector<std::string> packets = packets_of_frame(s, 1, random_columns(s, kStart, 3));
  ASSERT_EQ(packets[0].size(), 33'024U);
  const auto expected = points_in(sweeps_of(pcap(packets)));
  std::vector<std::string> fragments;
  for (unsigned i = 0; i < packets.size(); ++i) {
    for (const std::string& fragment : fragments_of(udp(packets[i]), i))
      fragments.push_back(fragment);
  }
  EXPECT_EQ(points_in(sweeps_of(pcap_of_ip(fragments))), expected);
}

TEST_F(Ouster, OfALegacy128HasThePacketSizeOfTheManual) {
  const MadeOuster s = made_ouster("LEGACY", 128, 512);
  EXPECT_EQ(packets_of_frame(s, 1, random_columns(s, kStart, 3))[0].size(), 24'896U);
}

TEST_F(Ouster, CutAnywhereIsReadUpToItsLastWholePacket) {
  MadeOuster s = made_ouster("RNG15_RFL8_NIR8", 2, 8);
  s.columns_per_packet = 2;
  put("a.json", nested_metadata(s));
  const std::string whole = pcap(packets_of_frame(s, 1, random_columns(s, kStart, 3)));
  const std::size_t record = (whole.size() - 24) / 4;
  for (std::size_t size = 1; size < whole.size(); ++size) {
    try {
      const auto sweeps = sweeps_of(whole.substr(0, size));
      ASSERT_EQ(sweeps.size(), 1U) << size;
      EXPECT_GE(size, 24 + record);
      EXPECT_LE(sweeps[0].points.size(), 2 * 2 * ((size - 24) / record));
    } catch (const IoError&) {
      EXPECT_LT(size, 24 + record);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
