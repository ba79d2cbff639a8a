// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "captured_sweeps.h"
#include "hesai_correction.h"
#include "made_hesai.h"
#include "made_livox.h"
#include "made_ouster.h"
#include "pcl_bv/recording/packet_reader.h"
#include "sensor_family.h"

namespace pcl_bv::detail {
namespace {

class HesaiRecognition : public CapturedSweeps {};

bool is_of_family(const SensorFamily& family, const std::string& bytes) {
  const Payload packet{0, reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()};
  return family.model_of(packet).has_value();
}

TEST_F(HesaiRecognition, PacketsThatDifferFromTheLayoutAreNoneOfItsPackets) {
  put("b.csv", hesai_correction(40));
  for (const std::size_t channels : {16U, 32U, 40U}) {
    const auto family = open_hesai(at(channels == 40 ? "b.pcap" : "a.pcap"));
    const MadeHesai s{channels, false, false};
    const std::string good = hesai_bytes(s, random_hesai(s, 0, 0, 1));
    EXPECT_TRUE(is_of_family(*family, good));
    for (std::size_t size = 0; size < good.size(); ++size)
      EXPECT_FALSE(is_of_family(*family, good.substr(0, size))) << size;
    EXPECT_FALSE(is_of_family(*family, good + '\0'));
    std::vector<std::size_t> fields{0, 1, good.size() - (channels == 40 ? 8 : 14)};
    for (std::size_t i = 2; i < 10; ++i) {
      if (channels == 40) fields.push_back(124 * i);
    }
    if (channels != 40) fields.insert(fields.end(), {2, 3, 6, 7, 9});
    for (const std::size_t field : fields) {
      std::string changed = good;
      changed[field] = static_cast<char>(changed[field] ^ 0x44);
      EXPECT_FALSE(is_of_family(*family, changed)) << channels << ", " << field;
    }
  }
}

TEST_F(HesaiRecognition, PacketsOfOtherSensorsAreNoneOfItsPackets) {
  put("a.csv", hesai_correction(40));
  const auto hesai = open_hesai(at("a.pcap")), velodyne = open_velodyne({}), livox = open_livox({});
  const MadeOuster ouster = made_ouster("LEGACY", 32);
  EXPECT_FALSE(is_of_family(*hesai, packet(0, 20, 0x37, 0x22)));
  EXPECT_FALSE(is_of_family(*hesai, livox_packet(random_livox(1, 0, 1))));
  EXPECT_FALSE(is_of_family(*hesai, packets_of_frame(ouster, 0, random_columns(ouster, 0, 1))[0]));
  // A Pandar40 has the same delimiter as a Velodyne, and here its product id.
  const MadeHesai s{40, false, false};
  std::string pandar = hesai_bytes(s, random_hesai(s, 0, 0, 1));
  pandar[1205] = 0x22;
  EXPECT_TRUE(is_of_family(*hesai, pandar));
  EXPECT_FALSE(is_of_family(*velodyne, pandar));
  EXPECT_FALSE(is_of_family(*livox, pandar));
  constexpr unsigned seed = 9;
  std::mt19937 random(seed);
  for (unsigned i = 0; i < 20'000; ++i) {
    std::string bytes(random() % 2 == 0 ? 1'080 : 1'262, '\0');
    for (char& byte : bytes)
      byte = static_cast<char>(random());
    EXPECT_FALSE(is_of_family(*hesai, bytes)) << i << ", seed " << seed;
  }
}

TEST_F(HesaiRecognition, SaysWhichCorrectionFileIsMissingOrUnusable) {
  const MadeHesai s{40};
  const std::string file = pcap({hesai_bytes(s, random_hesai(s, 0, 0, 1))});
  EXPECT_THAT(
      error_of(file),
      testing::EndsWith("a packet of a Hesai Pandar40 from 0.0.0.0:2368; the angle correction file of the "
                        "Hesai sensor is missing: put its .csv file next to the capture, as a.csv"));
  put("a.csv", hesai_correction(32));
  EXPECT_THAT(error_of(file), testing::EndsWith("a.csv has 32 channels, the sensor has 40"));
  put("a.csv", "something else\n");
  EXPECT_THAT(error_of(file),
              testing::EndsWith("a.csv is no usable angle correction file of a Hesai sensor: has no "
                                "rows \"channel,elevation,azimuth\""));
  put("a.csv", std::string(70'000, '1'));
  EXPECT_THAT(error_of(file), testing::HasSubstr("a.csv is no usable angle correction file"));
  std::string other = hesai_bytes({}, random_hesai({}, 0, 0, 1));
  other[2] = 4;
  EXPECT_THAT(error_of(pcap({other})),
              testing::EndsWith("a Hesai packet of version 4.1 with 1080 bytes from 0.0.0.0:2368"));
}

TEST_F(HesaiRecognition, CorrectionFilesAreCheckedLineByLine) {
  const auto error = [](const std::string& csv) -> std::string {
    try {
      parse_hesai_correction(csv);
    } catch (const IoError& e) {
      return e.what();
    }
    return "no error";
  };
  const auto angles = parse_hesai_correction(
      "\xEF\xBB\xBF"
      "Channel,Elevation,Azimuth\n1, 15.5 ,-1\n 2,-7e0,3.25");
  ASSERT_EQ(angles.size(), 2U);
  EXPECT_EQ(angles[0].elevation, 15.5);
  EXPECT_EQ(angles[1].elevation, -7);
  EXPECT_EQ(angles[1].azimuth, 3.25);
  EXPECT_EQ(error("1,2,3\n3,2,3\n"), "has channel 3 where channel 2 must be");
  EXPECT_EQ(error("1,2,3\n1,2,3\n"), "has channel 1 where channel 2 must be");
  EXPECT_EQ(error("0,2,3\n"), "has channel 0 where channel 1 must be");
  for (const char* row : {"1,90.1,0", "1,0,-361", "1,nan,0", "1,0,inf"})
    EXPECT_EQ(error(row), "has an elevation beyond 90 or an azimuth beyond 360 degrees for channel 1") << row;
  std::string many;
  for (int i = 1; i <= 129; ++i)
    many += std::to_string(i) + ",0,0\n";
  EXPECT_EQ(error(many), "has more than 128 channels");
  for (const char* text : {"", "\n\n", "1;2;3", "1,2", "1,2,3,4", ",,"})
    EXPECT_EQ(error(text), "has no rows \"channel,elevation,azimuth\"") << text;
}

}  // namespace
}  // namespace pcl_bv::detail
