// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Models with further layouts. Packets and expected points are written from the manuals' tables.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "made_hesai.h"
#include "made_hesai_mirrors.h"
#include "pcl_bv/recording/packet_reader.h"
#include "recording_files.h"
#include "sensor_family.h"

namespace pcl_bv::detail {
namespace {

// A layout by its sizes and by the positions in its tail.
struct Layout {
  const char* name;
  unsigned major, minor;
  std::size_t channels, blocks, channel_bytes, tail, mode_at, time_at;
  unsigned unit_mm, flags;
  std::size_t size;  // of the packet, by the manual
  bool mirrors = false;
};

constexpr Layout kLayouts[] = {
    {"PandarXT-32M2X", 6, 1, 32, 6, 4, 24, 10, 19, 5, 0x01, 820},
    {"PandarQT", 3, 1, 64, 4, 4, 24, 16, 12, 4, 0x01, 1'072},
    {"QT128C2X", 3, 2, 128, 2, 4, 26, 12, 21, 4, 0x15, 1'095},
    {"QT128C2X", 3, 2, 128, 2, 4, 26, 12, 21, 4, 0x1D, 1'127},
    {"QT128C2X", 3, 2, 128, 2, 3, 26, 12, 21, 4, 0x01, 822},
    {"Pandar128", 1, 4, 128, 2, 3, 26, 12, 21, 4, 0x07, 861},
    {"Pandar128", 1, 4, 128, 2, 3, 26, 12, 21, 4, 0x0F, 893},
    {"Pandar128", 1, 4, 128, 2, 4, 26, 12, 21, 4, 0x10, 1'074},
    {"AT128", 4, 3, 128, 2, 4, 32, 24, 20, 4, 0x11, 1'086, true},
    {"AT128", 4, 3, 128, 2, 4, 32, 24, 20, 4, 0x19, 1'118, true},
};

// Distances and reflectivities of all blocks and channels.
struct Sent {
  std::string bytes;
  std::vector<std::vector<MadeHesaiReturn>> blocks;
  std::vector<unsigned> azimuths;  // of each block, in units of 1/25600 degree
};

Sent made_packet(const Layout& l, unsigned mode, unsigned returns, unsigned azimuth, unsigned us,
                 unsigned seed) {
  std::mt19937 random(seed);
  Sent sent;
  std::string& bytes = sent.bytes;
  bytes = "\xEE\xFF" + bytes_of(l.major, 1) + bytes_of(l.minor, 1) + bytes_of(0, 2) +
          bytes_of(l.channels, 1) + bytes_of(l.blocks, 1) + bytes_of(0, 1) + bytes_of(l.unit_mm, 1) +
          bytes_of(returns, 1) + bytes_of(l.flags, 1);
  for (std::size_t i = 0; i < l.blocks; ++i) {
    const unsigned at = azimuth + static_cast<unsigned>(i / returns) * 20 * 256 + (l.mirrors ? 77 : 0);
    sent.azimuths.push_back(at);
    bytes += bytes_of(at / 256, 2) + (l.mirrors ? bytes_of(at % 256, 1) : "");
    auto& block = sent.blocks.emplace_back();
    for (std::size_t channel = 0; channel < l.channels; ++channel) {
      const unsigned distance =
          random() % 4 == 0 ? random() % 4 : 4 + static_cast<unsigned>(random()) % 60'000;
      block.emplace_back(distance, static_cast<unsigned>(random()) % 256);
      if (i % returns > 0 && random() % 8 == 0) block.back() = sent.blocks[i - 1][channel];
      bytes += bytes_of(block.back().first, 2) + bytes_of(block.back().second, 1) +
               (l.channel_bytes == 4 ? "\x5A" : "");
    }
  }
  const bool flags = l.channels == 128;
  if (flags) bytes += std::string(4, '\x5A');
  if (flags && !l.mirrors && (l.flags & 4U) != 0) bytes += std::string(17, '\x5A');
  std::string tail(l.tail, '\0');
  tail.replace(l.mode_at, 1, bytes_of(mode, 1));
  tail.replace(l.time_at, 4, bytes_of(us, 4));
  bytes += tail;
  if ((l.flags & 1U) != 0) bytes += bytes_of(us, 4);
  if (flags && !l.mirrors && (l.flags & 2U) != 0) bytes += std::string(22, '\x5A');
  if (flags) bytes += std::string(4, '\x5A');
  if (flags && (l.flags & 8U) != 0) bytes += std::string(32, '\x5A');
  return sent;
}

// The direction of a channel in a block, by the manuals: azimuth and elevation in degrees.
std::pair<double, double> direction_of(const Layout& l, unsigned azimuth, std::size_t channel) {
  if (l.mirrors) return mirrored(azimuth / 25'600.0, channel);
  const auto [elevation, offset] = hesai_angles(l.channels)[channel];
  return {azimuth / 25'600.0 + offset / 1000.0, elevation / 1000.0};
}

class HesaiModels : public RecordingFiles {
 protected:
  void put_corrections(const Layout& l) {
    put("a.csv", hesai_correction(l.channels));
    put("a.dat", mirror_file());
  }
  std::string error_of(const std::vector<std::string>& packets) {
    put("a.pcap", pcap(packets));
    try {
      PacketReader reader(at("a.pcap"));
    } catch (const IoError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(HesaiModels, PointsFollowTheManuals) {
  for (const Layout& l : kLayouts) {
    const bool triple = l.blocks == 6;
    for (const auto& [mode, returns] : {std::pair{0x33U, 1U}, {0x38U, 1U}, {0x3BU, 2U}, {0x3DU, 3U}}) {
      if (returns == 3 && !triple) continue;
      SCOPED_TRACE(testing::Message() << l.name << ", " << l.size << " bytes, " << returns << " returns");
      put_corrections(l);
      std::vector<std::string> packets;
      std::vector<Sent> all;
      for (unsigned i = 0; i < 20; ++i) {
        all.push_back(made_packet(l, mode, returns, (3'000 + i * 120) * 256, 1'000 + i * 300, i));
        packets.push_back(all.back().bytes);
        ASSERT_EQ(packets.back().size(), l.size);
      }
      put("a.pcap", pcap(packets));
      PacketReader reader(at("a.pcap"));
      EXPECT_EQ(reader.model(), l.name);
      SensorSweep sweep;
      ASSERT_TRUE(reader.next(sweep));
      std::size_t n = 0;
      const unsigned smallest = std::string(l.name) == "Pandar128" ? 4 : 1;
      for (const Sent& sent : all) {
        for (std::size_t i = 0; i < l.blocks; i += returns) {
          for (std::size_t channel = 0; channel < l.channels; ++channel) {
            for (std::size_t which = 0; which < returns; ++which) {
              const auto& got_from = sent.blocks[i + which][channel];
              const bool repeated = (which > 0 && (got_from == sent.blocks[i][channel] ||
                                                   got_from == sent.blocks[i + which - 1][channel]));
              if (got_from.first < smallest || repeated) continue;
              ASSERT_LT(n, sweep.points.size());
              const SensorPoint& got = sweep.points[n++];
              const auto [azimuth, elevation] = direction_of(l, sent.azimuths[i], channel);
              constexpr double degree = std::numbers::pi / 180;
              const double metres = got_from.first * l.unit_mm / 1000.0,
                           level = metres * std::cos(elevation * degree);
              ASSERT_NEAR(got.x, level * std::sin(azimuth * degree), 2e-5) << channel;
              ASSERT_NEAR(got.y, level * std::cos(azimuth * degree), 2e-5) << channel;
              ASSERT_NEAR(got.z, metres * std::sin(elevation * degree), 2e-5) << channel;
              ASSERT_EQ(got.intensity, static_cast<float>(got_from.second));
              ASSERT_EQ(got.ring, channel);
            }
          }
        }
      }
      EXPECT_EQ(n, sweep.points.size());
      EXPECT_FALSE(reader.next(sweep));
      EXPECT_THAT(reader.warning_lines(), testing::IsEmpty());
    }
  }
}

TEST_F(HesaiModels, PacketsOfOtherSizesAndModesAreNotDecoded) {
  for (const Layout& l : kLayouts) {
    SCOPED_TRACE(testing::Message() << l.name << ", " << l.size << " bytes");
    put_corrections(l);
    const auto family = open_hesai(at("a.pcap"));
    const auto is_decoded = [&](const std::string& bytes) {
      const Payload packet{0, reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
      return family->model_of(packet).has_value();
    };
    const std::string good = made_packet(l, 0x37, 1, 0, 0, 1).bytes;
    EXPECT_TRUE(is_decoded(good));
    for (std::size_t size = 0; size < good.size(); ++size) {
      if (l.channels < 128 && size + 4 == good.size()) continue;  // without its sequence number
      EXPECT_FALSE(is_decoded(good.substr(0, size))) << size;
    }
    EXPECT_FALSE(is_decoded(good + '\0'));
    EXPECT_FALSE(is_decoded(made_packet(l, 0x40, 1, 0, 0, 1).bytes));
    for (const std::size_t field : {0, 1, 2, 3, 6, 7, 9}) {
      std::string changed = good;
      changed[field] = static_cast<char>(changed[field] ^ 0x44);
      EXPECT_FALSE(is_decoded(changed)) << field;
    }
  }
}

TEST_F(HesaiModels, AFrameOfAnAt128IsTheRotationOfOneMirror) {
  const Layout& l = kLayouts[8];
  put_corrections(l);
  std::vector<std::string> packets;
  for (unsigned i = 0; i < 2'250; ++i)  // 2.5 revolutions of 900 packets from 30 degrees on
    packets.push_back(made_packet(l, 0x37, 1, (3'000 + i * 40) % 36'000 * 256, 83 * i, i).bytes);
  put("a.pcap", pcap(packets));
  PacketReader reader(at("a.pcap"));
  std::size_t frames = 0;
  for (SensorSweep sweep; reader.next(sweep); ++frames) {
    const double packets_of_frame = frames == 0 ? 283.3 : frames == 7 ? 166.7 : 300;
    EXPECT_NEAR(static_cast<double>(sweep.points.size()), packets_of_frame * 240, 600) << frames;
  }
  EXPECT_EQ(frames, 8U);
  EXPECT_THAT(reader.warning_lines(), testing::IsEmpty());
}

TEST_F(HesaiModels, SaysWhatIsWrongWithTheFileOfTheMirrors) {
  const std::vector<std::string> packets{made_packet(kLayouts[8], 0x37, 1, 0, 0, 1).bytes};
  EXPECT_THAT(error_of(packets),
              testing::EndsWith("is missing: put its .dat file next to the capture, as a.dat"));
  const std::string good = mirror_file();
  const auto error = [&](const std::string& bytes) {
    put("a.dat", bytes);
    return error_of(packets);
  };
  EXPECT_EQ(error(good), "no error");
  for (std::size_t size = 0; size < good.size(); size += size < 40 ? 1 : 997)
    EXPECT_THAT(error(good.substr(0, size)), testing::HasSubstr("a.dat is no usable angle correction file"))
        << size;
  EXPECT_THAT(error(good + "x"), testing::EndsWith("has 47177 bytes instead of 47176"));
  const auto changed = [&](std::size_t at, char byte) {
    std::string bytes = good;
    bytes[at] = byte;
    return error(bytes);
  };
  EXPECT_THAT(changed(0, 0), testing::EndsWith("does not begin with 0xEE 0xFF"));
  EXPECT_THAT(changed(3, 3), testing::EndsWith("has version 1.3, and only version 1.5 is supported"));
  EXPECT_THAT(changed(5, 9), testing::HasSubstr("has 128 channels, 9 mirrors and the unit 2;"));
  EXPECT_THAT(changed(15, 0), testing::HasSubstr("3 mirrors and the unit 0;"));
  EXPECT_THAT(changed(43, 0x7F),
              testing::EndsWith("an elevation beyond 90 or an azimuth beyond 360 degrees"));
}

}  // namespace
}  // namespace pcl_bv::detail
