// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The time and the azimuth of each laser of a Velodyne, and limited fields of view.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "captured_sweeps.h"
#include "made_packets.h"
#include "pcl_bv/recording/packet_reader.h"

namespace pcl_bv::detail {
namespace {

struct FiringModel {
  std::uint8_t factory;
  double block_us;
  unsigned step;  // hundredths of a degree between blocks, at about 10 Hz
};
constexpr FiringModel kFiringModels[] = {{0x22, 110.592, 40}, {0x21, 46.080, 17}, {0x28, 55.296, 20}};

struct TimedPacket {
  double us;  // capture time
  std::string payload;
};

// The manuals' time of a laser after the first one of its block, microseconds.
double laser_us(const FiringModel& model, std::size_t laser) {
  if (model.factory == 0x22)
    return 55.296 * static_cast<double>(laser / 16) + 2.304 * static_cast<double>(laser % 16);
  if (model.factory == 0x21) return 1.152 * static_cast<double>(laser);
  return 2.304 * static_cast<double>(laser / 2);
}

// Packets of a sensor that turns from azimuth `from` on and sends only the firings from `start` to `end`
// (hundredths of a degree). With `clock`, the packets have the sensor's times.
std::vector<TimedPacket> packets_in_view(const FiringModel& model, unsigned start, unsigned end, bool dual,
                                         bool clock, unsigned from = 0, double revolutions = 5) {
  std::vector<TimedPacket> packets;
  std::string blocks;
  const auto count = static_cast<unsigned>(revolutions * 36'000 / model.step);
  double first_us = 0;
  for (unsigned i = 0; i < count; ++i) {
    const unsigned azimuth = (from + i * model.step) % 36'000;
    const bool visible =
        start <= end ? azimuth >= start && azimuth <= end : azimuth >= start || azimuth <= end;
    if (!visible) continue;
    const double us = 1e6 + i * model.block_us;
    if (blocks.empty()) first_us = us;
    for (unsigned which = 0; which < (dual ? 2U : 1U); ++which) {
      blocks += bytes_of(0xEEFF, 2) + bytes_of(azimuth, 2);
      for (unsigned laser = 0; laser < 32; ++laser)
        blocks += bytes_of(1000 + laser + 500 * which, 2) + bytes_of(laser, 1);
    }
    if (blocks.size() < 1200) continue;
    blocks += bytes_of(clock ? static_cast<std::uint64_t>(first_us) : 0, 4) +
              bytes_of(dual ? 0x39 : 0x37, 1) + bytes_of(model.factory, 1);
    packets.push_back({us, std::exchange(blocks, {})});
  }
  return packets;
}

std::string timed_capture(const std::vector<TimedPacket>& packets) {
  std::string file = pcap({});
  for (const TimedPacket& made : packets) {
    std::string one = pcap({made.payload}).substr(24);
    const auto us = static_cast<std::uint64_t>(made.us);
    file += one.replace(0, 8, bytes_of(us / 1'000'000, 4) + bytes_of(us % 1'000'000, 4));
  }
  return file;
}

double degrees_of(const SensorPoint& point) {
  const double degrees = std::atan2(point.x, point.y) * 180 / std::numbers::pi;
  return degrees < 0 ? degrees + 360 : degrees;
}

// The number of points in each passage of the field of view.
std::vector<std::size_t> passages_in(const std::vector<TimedPacket>& packets) {
  std::vector<std::size_t> sizes;
  unsigned last = 0;
  for (const TimedPacket& made : packets) {
    for (std::size_t block = 0; block < 12; ++block) {
      const auto* const at = reinterpret_cast<const unsigned char*>(made.payload.data() + 100 * block + 2);
      const unsigned azimuth = at[0] + 256U * at[1];
      if (sizes.empty() || (azimuth + 36'000 - last) % 36'000 > 500) sizes.push_back(0);
      sizes.back() += 32;
      last = azimuth;
    }
  }
  return sizes;
}

class VelodyneFiring : public CapturedSweeps {
 protected:
  void expect_one_sensor(const std::vector<SensorSweep>& sweeps) {
    EXPECT_THAT(warnings_, testing::IsEmpty());
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      EXPECT_EQ(sweeps[i].sensor, 0U);
      if (i > 0) {
        EXPECT_GT(sweeps[i].stamp_ns, sweeps[i - 1].stamp_ns);
      }
    }
  }
};

std::vector<std::size_t> point_counts(const std::vector<SensorSweep>& sweeps) {
  std::vector<std::size_t> sizes;
  for (const SensorSweep& sweep : sweeps)
    sizes.push_back(sweep.points.size());
  return sizes;
}

TEST_F(VelodyneFiring, OfEachLaserHasTheTimeAndAzimuthOfTheManual) {
  for (const FiringModel& model : kFiringModels) {
    for (const bool dual : {false, true}) {
      SCOPED_TRACE(testing::Message() << int{model.factory} << ' ' << dual);
      const auto sweeps =
          sweeps_of(timed_capture(packets_in_view(model, 0, 35'999, dual, true, 35'900, 0.1)));
      ASSERT_EQ(sweeps.size(), 2U);
      // The offsets of the VLP-32C's beams are unknown here, so azimuths are compared with the second firing.
      const std::vector<SensorPoint> points(sweeps[1].points.begin(), sweeps[1].points.end());
      const std::size_t returns = dual ? 2 : 1, block = 32 * returns;
      ASSERT_GT(points.size(), 4 * block);
      for (std::size_t i = 0; i < 3 * block; ++i) {
        const std::size_t laser = i % block / returns;
        const double us = laser_us(model, laser);
        const auto since_block =
            static_cast<double>(points[i].time_ns) - static_cast<double>(points[i - i % block].time_ns);
        EXPECT_NEAR(since_block, 1000 * us, 1) << i;
        EXPECT_NEAR(degrees_of(points[i + block]) - degrees_of(points[i]), 0.01 * model.step, 2e-4) << i;
        if (model.factory == 0x28) continue;
        const double turned = degrees_of(points[i]) - degrees_of(points[i - i % block]);
        EXPECT_NEAR(turned, 0.01 * model.step * us / model.block_us, 1e-4) << i;
      }
    }
  }
}

TEST_F(VelodyneFiring, AtTheEndOfAPacketAndBeforeAGapHasTheRotationBefore) {
  const auto sweeps = sweeps_of(timed_capture(packets_in_view(kFiringModels[0], 27'000, 9'000, false, true)));
  for (const SensorSweep& sweep : sweeps) {
    for (std::size_t i = 0; i + 31 < sweep.points.size(); i += 32) {
      const double turned = degrees_of(sweep.points[i + 31]) - degrees_of(sweep.points[i]);
      ASSERT_NEAR(turned, 0.4 * 89.856 / 110.592, 1e-4) << i;
    }
  }
}

TEST_F(VelodyneFiring, InALimitedFieldOfViewGivesASweepForEachPassage) {
  struct View {
    unsigned start, end;
  };
  for (const FiringModel& model : kFiringModels) {
    for (const View& view : {View{0, 9'000}, View{27'000, 9'000}, View{10'000, 11'000}, View{35'500, 500},
                             View{500, 35'500}, View{18'500, 17'000}}) {
      for (const int variant : {0, 1, 2, 3}) {
        const bool dual = variant % 2 == 1, clock = variant < 2;
        SCOPED_TRACE(testing::Message() << int{model.factory} << ' ' << view.start << ' ' << variant);
        const std::vector<TimedPacket> packets =
            packets_in_view(model, view.start, view.end, dual, clock, dual ? 28'040 : 28'000);
        const auto sweeps = sweeps_of(timed_capture(packets));
        expect_one_sensor(sweeps);
        EXPECT_EQ(point_counts(sweeps), passages_in(packets));
        for (const SensorSweep& sweep : sweeps)
          for (const SensorPoint& point : sweep.points)
            ASSERT_LT(point.time_ns, 105'000'000U);
      }
    }
  }
}

TEST_F(VelodyneFiring, InALimitedFieldOfViewToleratesLateAndLostPackets) {
  const std::vector<TimedPacket> packets = packets_in_view(kFiringModels[0], 27'000, 9'000, false, true);
  const std::vector<std::size_t> expected = point_counts(sweeps_of(timed_capture(packets)));
  ASSERT_EQ(expected.size(), 6U);
  for (std::size_t i = 25; i + 1 < packets.size(); i += 3) {
    SCOPED_TRACE(i);
    std::vector<TimedPacket> changed = packets;
    std::swap(changed[i].payload, changed[i + 1].payload);
    auto sweeps = sweeps_of(timed_capture(changed));
    expect_one_sensor(sweeps);
    EXPECT_EQ(point_counts(sweeps), expected);
    changed = packets;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(i));
    sweeps = sweeps_of(timed_capture(changed));
    expect_one_sensor(sweeps);
    EXPECT_EQ(sweeps.size(), expected.size());
  }
}

TEST_F(VelodyneFiring, OfTwoSensorsWithGapsBehindOneAddressStayApart) {
  // Both are in view at first: while one is in its gap, nothing says that another one has begun.
  std::vector<TimedPacket> packets = packets_in_view(kFiringModels[0], 27'000, 9'000, false, true, 27'000);
  for (TimedPacket& made : packets_in_view(kFiringModels[0], 27'000, 9'000, false, true)) {
    made.us += 100;
    packets.push_back(made);
  }
  std::sort(packets.begin(), packets.end(),
            [](const TimedPacket& a, const TimedPacket& b) { return a.us < b.us; });
  const auto sweeps = sweeps_of(timed_capture(packets));
  std::size_t points[2] = {};
  for (const SensorSweep& sweep : sweeps) {
    ASSERT_LT(sweep.sensor, 2U);
    points[sweep.sensor] += sweep.points.size();
  }
  EXPECT_EQ(points[0] + points[1], packets.size() * 12 * 32);
  EXPECT_NEAR(static_cast<double>(points[0]), static_cast<double>(points[1]), 1'000);
  EXPECT_THAT(warnings_, testing::ElementsAre(testing::StartsWith("packets of 2 sensors")));
}

}  // namespace
}  // namespace pcl_bv::detail
