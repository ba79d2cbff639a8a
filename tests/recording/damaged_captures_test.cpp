// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Damaged and unusual captures: only the packets that are hit are lost.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "made_packets.h"
#include "pcl_bv/recording/packet_reader.h"
#include "recording_files.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kPoints = 12 * 32;  // of a packet
constexpr std::size_t kPcapHeader = 24, kPacketHeader = 16;

std::vector<std::string> packets_of(std::uint8_t factory, std::size_t number, unsigned from = 0) {
  std::vector<std::string> payloads;
  for (unsigned i = 0; i < number; ++i)
    payloads.push_back(packet((from + 480 * i) % 36'000, 40, 0x37, factory));
  return payloads;
}

class DamagedCapture : public RecordingFiles {
 protected:
  // The points of each sensor.
  std::map<std::size_t, std::size_t> points_of(const std::string& file, const std::string& sensor = {}) {
    put("a.pcap", file);
    PacketReader reader(at("a.pcap"), sensor);
    std::map<std::size_t, std::size_t> points;
    for (SensorSweep sweep; reader.next(sweep);) {
      points[sweep.sensor] += sweep.points.size();
      newest_ns_ = std::max(newest_ns_, sweep.stamp_ns);
    }
    warnings_ = reader.warning_lines();
    return points;
  }
  // Captured in 2023, as other times are no problem.
  static std::string recent_pcap(const std::vector<std::string>& payloads) {
    std::string file = pcap(payloads);
    for (std::size_t i = 0; i < payloads.size(); ++i)
      file.replace(header(file, payloads.size(), i), 4, pcl_bv::bytes_of(1'700'000'000, 4));
    return file;
  }
  static std::size_t header(const std::string& file, std::size_t packets, std::size_t number) {
    return kPcapHeader + (file.size() - kPcapHeader) / packets * number;
  }
  static void add(std::string& file, std::size_t at, std::uint32_t more) {
    std::uint32_t value;
    std::memcpy(&value, file.data() + at, 4);
    file.replace(at, 4, pcl_bv::bytes_of(value + more, 4));
  }

  std::vector<std::string> warnings_;
  std::int64_t newest_ns_ = 0;
};

TEST_F(DamagedCapture, AFirstHeaderCostsItsPacket) {
  std::string file = recent_pcap(packets_of(0x22, 60));
  file.replace(kPcapHeader, kPacketHeader, std::string(kPacketHeader, '\xFE'));
  EXPECT_EQ(points_of(file)[0], 59 * kPoints);
  EXPECT_THAT(warnings_,
              testing::ElementsAre("skipped damaged bytes 24 to " + std::to_string(header(file, 60, 1) - 1)));
}

TEST_F(DamagedCapture, ALengthThatIsALittleTooLargeCostsItsPacket) {
  for (const std::uint32_t more : {4U, 1300U}) {
    for (const bool both : {false, true}) {
      for (const std::size_t number : {0U, 30U, 58U}) {
        SCOPED_TRACE(testing::Message() << more << ' ' << both << ' ' << number);
        std::string file = recent_pcap(packets_of(0x22, 60));
        const std::size_t at = header(file, 60, number);
        add(file, at + 8, more);
        if (both) add(file, at + 12, more);
        EXPECT_GE(points_of(file)[0], 59 * kPoints);
        EXPECT_EQ(warnings_.size(), 1U);
      }
    }
  }
}

TEST_F(DamagedCapture, AByteOfAHeaderCostsAtMostItsPacket) {
  const std::string whole = recent_pcap(packets_of(0x22, 60));
  for (const std::size_t number : {0U, 30U, 58U, 59U}) {
    for (std::size_t byte = 0; byte < kPacketHeader; ++byte) {
      for (const char value : {'\0', '\1', '\x20', '\x7F', '\xFF'}) {
        std::string file = whole;
        file[header(file, 60, number) + byte] = value;
        std::size_t points = 0;
        for (const auto& [sensor, some] : points_of(file))
          points += some;
        EXPECT_GE(points, 59 * kPoints) << number << ' ' << byte << ' ' << static_cast<int>(value);
      }
    }
  }
}

TEST_F(DamagedCapture, ATimeOutOfOrderCostsItsPacket) {
  std::string file = recent_pcap(packets_of(0x22, 60));
  add(file, header(file, 60, 20), 1'000'000);
  EXPECT_EQ(points_of(file)[0], 59 * kPoints);
}

// Captures that were joined.
TEST_F(DamagedCapture, TimesMayJumpByDays) {
  std::string file = recent_pcap(packets_of(0x22, 60));
  for (std::size_t i = 30; i < 60; ++i)
    add(file, header(file, 60, i), 1'000'000);
  EXPECT_EQ(points_of(file)[0], 60 * kPoints);
  EXPECT_THAT(warnings_, testing::IsEmpty());
}

// Each of the headers could begin a packet whose successor lies 1 MiB farther, which was read each time.
TEST_F(DamagedCapture, ASearchReadsTheFileOnce) {
  const std::size_t length = 1'048'570;
  std::string file = recent_pcap(packets_of(0x22, 2)) + std::string(16, '\xFE');
  const std::string head = pcl_bv::bytes_of(1'700'000'000, 4) + pcl_bv::bytes_of(0, 4) +
                           pcl_bv::bytes_of(length, 4) + pcl_bv::bytes_of(length, 4);
  for (int i = 0; i < 500; ++i)
    file += head;
  file += std::string(2U << 20U, '\xFE');
  const std::uint64_t before = bytes_read();
  EXPECT_EQ(points_of(file)[0], 2 * kPoints);
  EXPECT_LT(bytes_read() - before, 20 * file.size());
}

TEST_F(DamagedCapture, ATimeThatNoClockHasIsBounded) {
  const std::string file = pcapng(packets_of(0x22, 3), false, 0, std::uint64_t{1} << 40U);
  EXPECT_GT(points_of(file)[0], 0U);
  EXPECT_GT(newest_ns_, 8'000'000'000'000'000'000);
}

// Two models behind one address and port; one of them jumps.
TEST_F(DamagedCapture, APacketGoesToASensorOfItsModel) {
  std::vector<std::string> payloads;
  const std::vector<std::string> first = packets_of(0x22, 150);
  std::vector<std::string> second = packets_of(0x21, 75);
  const std::vector<std::string> jumped = packets_of(0x21, 75, 14'400);
  second.insert(second.end(), jumped.begin(), jumped.end());
  for (std::size_t i = 0; i < 150; ++i)
    payloads.insert(payloads.end(), {first[i], second[i]});
  for (const bool cut : {false, true}) {
    if (cut) payloads.resize(2 * 75 + 2);  // the jump comes last
    auto points = points_of(recent_pcap(payloads));
    EXPECT_EQ(points.size(), 2U);
    EXPECT_EQ(points[0], payloads.size() / 2 * kPoints);
    EXPECT_EQ(points[1], payloads.size() / 2 * kPoints);
    EXPECT_THAT(warnings_,
                testing::ElementsAre(testing::StartsWith("packets of 2 sensors (0.0.0.0:2368): ")));
  }
}

// A relay that opens a socket for each packet.
TEST_F(DamagedCapture, TheSendersPortDoesNotMatter) {
  std::string file = recent_pcap(packets_of(0x22, 150));
  for (std::size_t i = 0; i < 150; ++i)
    file.replace(header(file, 150, i) + kPacketHeader + 14 + 20, 2, pcl_bv::bytes_of(40'000 + i, 2, true));
  EXPECT_EQ(points_of(file), (std::map<std::size_t, std::size_t>{{0, 150 * kPoints}}));
  EXPECT_THAT(warnings_, testing::IsEmpty());
}

TEST_F(DamagedCapture, ManySensorsAreNamedInOneLine) {
  std::string file = recent_pcap(packets_of(0x22, 100));
  for (std::size_t i = 0; i < 100; ++i)
    file.replace(header(file, 100, i) + kPacketHeader + 14 + 12, 4,
                 "\x0A" + std::string(2, '\1') + static_cast<char>(i + 1));
  EXPECT_EQ(points_of(file).size(), 100U);
  EXPECT_THAT(warnings_,
              testing::ElementsAre(
                  "packets of 100 sensors (10.1.1.1:2368, 10.1.1.2:2368, 10.1.1.3:2368, 10.1.1.4:2368, "
                  "10.1.1.5:2368 and 95 others): each frame is from one of them, "
                  "--topic chooses one"));
}

// Two sensors behind the one address that was chosen, and others that were not.
TEST_F(DamagedCapture, AChosenAddressIsTheOnlyOneNamed) {
  std::vector<std::string> payloads;
  const std::vector<std::string> one = packets_of(0x22, 100), other = packets_of(0x22, 100, 18'000);
  for (std::size_t i = 0; i < 100; ++i)
    payloads.insert(payloads.end(), {one[i], other[i], one[i]});
  std::string file = recent_pcap(payloads);
  for (std::size_t i = 2; i < 300; i += 3)
    file.replace(header(file, 300, i) + kPacketHeader + 14 + 12, 4, "\x0A\1\1\1");
  EXPECT_EQ(points_of(file, "0.0.0.0:2368").size(), 2U);
  EXPECT_THAT(warnings_,
              testing::ElementsAre("packets of 2 sensors (0.0.0.0:2368): each frame is from one of them"));
}

}  // namespace
}  // namespace pcl_bv::detail
