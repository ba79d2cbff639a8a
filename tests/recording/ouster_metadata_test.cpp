// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The metadata of Ouster sensors: where they are found, and which are refused.

#include "ouster_metadata.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "made_ouster.h"
#include "pcl_bv/recording/packet_reader.h"
#include "recording_files.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

class OusterMetadataFile : public RecordingFiles {
 protected:
  void SetUp() override {
    RecordingFiles::SetUp();
    put("a.pcap", pcap(packets_of_frame(sensor_, 1, random_columns(sensor_, 1'000'000, 3))));
  }
  std::string error_of() {
    try {
      PacketReader reader(at("a.pcap"));
      SensorSweep sweep;
      return reader.next(sweep) ? "a sweep" : "no sweep";
    } catch (const IoError& error) {
      return error.what();
    }
  }
  MadeOuster sensor_ = made_ouster("RNG19_RFL8_SIG16_NIR16", 32);
};

TEST_F(OusterMetadataFile, IsRequiredAndTheErrorSaysWhere) {
  EXPECT_EQ(error_of(),
            "no packet that can be decoded (VLP-16, HDL-32E, VLP-32C, Hesai PandarXT-32, PandarXT-16, "
            "PandarXT-32M2X, PandarQT, QT128, Pandar128, OT128, AT128, Pandar64, Pandar40P, Pandar40M, "
            "Livox Mid-360, HAP, Ouster OS-0, OS-1, OS-2); UDP packets: an Ouster packet of "
            "6400 bytes from 0.0.0.0:2368; the metadata of the Ouster sensor is missing: put its "
            ".json file next to the capture, as a.json");
}

TEST_F(OusterMetadataFile, HasTheNameOfTheCaptureOrIsTheOnlyOneInItsFolder) {
  MadeOuster unknown = sensor_;
  unknown.serial = 0;
  put("other.json", "[1, 2]");
  put("b.json", nested_metadata(unknown));
  EXPECT_EQ(error_of(), "a sweep");
  unknown.altitudes[0] += 1;
  put("c.json", nested_metadata(unknown));
  EXPECT_THAT(error_of(), HasSubstr("b.json is of an unknown sensor with packets of 6400 bytes"));
  EXPECT_THAT(error_of(),
              HasSubstr(": put the metadata of the packets' sensor next to the capture, as a.json "
                        "or a_0.json"));
  put("a.json", flat_metadata(sensor_));
  EXPECT_EQ(error_of(), "a sweep");
  put("a.json", "{\"beam_altitude_angles\": [");
  EXPECT_THAT(error_of(), HasSubstr("a.json is no usable metadata of an Ouster sensor: truncated JSON"));
}

// As Ouster's tools name them.
TEST_F(OusterMetadataFile, MayHaveANumberAfterTheNameOfTheCapture) {
  MadeOuster other = sensor_;
  other.serial = 0;
  put("b_0.json", nested_metadata(other));
  put("c.json", nested_metadata(other));
  put("ab_0.json", nested_metadata(other));
  put("a_x.json", nested_metadata(other));
  EXPECT_NE(error_of(), "a sweep");
  put("a_0.json", nested_metadata(other));
  EXPECT_EQ(error_of(), "a sweep");
  other.altitudes[0] += 1;
  put("a_1.json", nested_metadata(other));
  EXPECT_THAT(error_of(),
              HasSubstr("a_0.json and a_1.json are metadata of Ouster sensors: name one of them a.json"));
  put("a_1.pcap", "a capture of its own");
  EXPECT_EQ(error_of(), "a sweep");
  put("a.json", nested_metadata(other));
  EXPECT_EQ(error_of(), "a sweep");
}

TEST_F(OusterMetadataFile, WithTheSerialNumberOfThePacketsIsUsed) {
  MadeOuster other = sensor_;
  for (const std::string name : {"a_0.json", "b_0.json", "c.json"}) {
    ++other.serial;
    put(name, nested_metadata(other));
  }
  EXPECT_THAT(error_of(), HasSubstr("a_0.json is of sensor 122201000999 with packets of 6400 bytes"));
  put("d_0.json", nested_metadata(sensor_));
  EXPECT_EQ(error_of(), "a sweep");
  put("e_0.json", nested_metadata(sensor_));  // the same metadata again
  EXPECT_EQ(error_of(), "a sweep");
  other = sensor_;
  other.altitudes[3] += 0.5;
  put("f_0.json", nested_metadata(other));
  EXPECT_THAT(error_of(), HasSubstr("d_0.json, e_0.json and f_0.json are metadata of Ouster sensors"));
}

TEST_F(OusterMetadataFile, OfEachSensorOfACaptureDecodesItsPackets) {
  for (const bool legacy : {false, true}) {
    MadeOuster one = made_ouster(legacy ? "LEGACY" : "RNG19_RFL8_SIG16_NIR16", 16), two = one;
    two.serial += 1;
    for (double& altitude : two.altitudes)
      altitude = -altitude;
    std::vector<std::string> payloads;
    for (const MadeOuster* const sensor : {&one, &two})
      for (const std::string& packet : packets_of_frame(*sensor, 1, random_columns(*sensor, 1'000'000, 3)))
        payloads.push_back(packet);
    std::string file = pcap(payloads);
    const std::size_t record = (file.size() - 24) / payloads.size(), port_at = 16 + 14 + 20 + 2;
    for (std::size_t i = 0; legacy && i < payloads.size(); ++i)
      file.replace(24 + i * record + port_at, 2,
                   pcl_bv::bytes_of(i < payloads.size() / 2 ? 7502 : 7503, 2, true));
    put("x.y_0.pcap", file);
    std::string metadata = nested_metadata(two);
    put("x.y_0_0.json", nested_metadata(one));
    put("x.y_0_1.json", metadata.replace(metadata.find("7502"), 4, "7503"));
    PacketReader reader(at("x.y_0.pcap"));
    std::vector<SensorSweep> sweeps;
    for (SensorSweep sweep; reader.next(sweep);)
      sweeps.push_back(sweep);
    ASSERT_EQ(sweeps.size(), 2U);
    ASSERT_EQ(sweeps[0].points.size(), sweeps[1].points.size());
    EXPECT_EQ(sweeps[0].sensor + sweeps[1].sensor, 1U);
    const double up = sweeps[0].points[0].z - 0.03618, down = sweeps[1].points[0].z - 0.03618;
    EXPECT_NEAR(up, -down, 1e-3 * std::abs(up));
  }
}

TEST_F(OusterMetadataFile, OfOtherPacketsIsNamed) {
  MadeOuster other = sensor_;
  other.profile = "LEGACY";
  put("a.json", flat_metadata(other));
  EXPECT_THAT(
      error_of(),
      HasSubstr("an Ouster packet of 6400 bytes from 0.0.0.0:2368; a.json is of sensor 122201000998 with "
                "packets of 6464 bytes (LEGACY, 32 beams)"));
  other = sensor_;
  other.serial = 5;
  put("a.json", flat_metadata(other));
  EXPECT_THAT(error_of(),
              HasSubstr("an Ouster packet of 6400 bytes of sensor 122201000998 from 0.0.0.0:2368; "
                        "a.json is of sensor 5 with packets of 6400 bytes"));
}

TEST_F(OusterMetadataFile, IsNotReadIfItIsLarge) {
  put("a.json", nested_metadata(sensor_) + std::string(1U << 20U, ' '));
  EXPECT_THAT(error_of(), HasSubstr("has more than 1048576 bytes"));
}

TEST_F(OusterMetadataFile, OfAVelodynesFolderDoesNotMatter) {
  put("a.json", "[");
  put("a.pcap", pcap({packet(9000, 40, 0x37, 0x22)}));
  EXPECT_EQ(error_of(), "a sweep");
}

// Two families in one capture.
TEST_F(OusterMetadataFile, IsMissedInAWarningIfOtherPacketsCanBeDecoded) {
  put("a.pcap", pcap({packet(9000, 40, 0x37, 0x22), ouster_packet(sensor_, 1, random_columns(sensor_, 0, 1)),
                      packet(9480, 40, 0x37, 0x22)}));
  const auto read = [&] {
    PacketReader reader(at("a.pcap"));
    std::vector<std::string_view> frame_ids;
    for (SensorSweep sweep; reader.next(sweep);)
      frame_ids.push_back(sweep.frame_id);
    std::vector<std::string> lines = reader.warning_lines();
    for (const std::string_view id : frame_ids)
      lines.emplace_back(id);
    return lines;
  };
  sensor_.columns_per_packet = sensor_.columns;
  EXPECT_THAT(read(),
              testing::ElementsAre(HasSubstr("cannot decode an Ouster packet of 25408 bytes"), "velodyne"));
  put("a.json", nested_metadata(sensor_));
  EXPECT_THAT(read(), testing::ElementsAre(HasSubstr("packets of 2 sensors (0.0.0.0:2368)"), "velodyne",
                                           "os_sensor"));
}

TEST(OusterMetadata, OfEitherLayoutIsTheSame) {
  MadeOuster s = made_ouster("RNG15_RFL8_NIR8", 64, 1024);
  for (const bool nested : {false, true}) {
    const OusterMetadata made = parse_ouster_metadata(nested ? nested_metadata(s) : flat_metadata(s));
    EXPECT_EQ(made.model, nested ? "OS-0-64" : "OS-1-64");
    EXPECT_EQ(made.serial, s.serial);
    EXPECT_EQ(made.profile->name, s.profile);
    EXPECT_EQ(made.beams, 64U);
    EXPECT_EQ(made.columns_per_packet, 16U);
    EXPECT_EQ(made.columns_per_frame, 1024U);
    EXPECT_EQ(made.altitudes[63], std::stod(std::to_string(s.altitudes[63])));
    EXPECT_EQ(made.azimuths[1], std::stod(std::to_string(s.azimuths[1])));
    EXPECT_EQ(made.beam_x_mm, s.beam_x);
    EXPECT_EQ(made.lidar_to_sensor, s.lidar_to_sensor);
    s.serial = 7;
  }
}

// Firmware 1.12 says neither the format of the packets nor the beams' origin.
TEST(OusterMetadata, OfEarlyFirmwareHasTheDefaultsOfTheSdk) {
  const MadeOuster s = made_ouster("LEGACY", 64);
  const auto text = [&](const std::string& model) {
    return "{\"prod_line\": \"" + model +
           "\", \"lidar_mode\": \"2048x10\", \"beam_altitude_angles\": " + json_list(s.altitudes) +
           ", \"beam_azimuth_angles\": " + json_list(s.azimuths) +
           ", \"lidar_to_sensor_transform\": " + json_list(s.lidar_to_sensor) + "}";
  };
  const OusterMetadata made = parse_ouster_metadata(text("OS-1-64"));
  EXPECT_EQ(made.profile->name, "LEGACY");
  EXPECT_EQ(made.columns_per_frame, 2048U);
  EXPECT_EQ(made.packet_size(), 12'608U);
  EXPECT_EQ(made.beam_x_mm, 15.806);
  EXPECT_EQ(parse_ouster_metadata(text("OS-0-64")).beam_x_mm, 27.67);
  EXPECT_EQ(parse_ouster_metadata(text("OS-2-64")).beam_x_mm, 13.762);
  EXPECT_EQ(parse_ouster_metadata(text("OS1-64")).beam_x_mm, 12.163);
}

TEST(OusterMetadata, WithValuesOutOfRangeIsRefused) {
  const std::string good = nested_metadata(made_ouster("LEGACY"));
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string bad = good;
    const std::size_t at = bad.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    bad.replace(at, from.size(), to);
    try {
      parse_ouster_metadata(bad);
    } catch (const IoError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(said("\"LEGACY\"", "\"FIVE_WORD_PIXEL\""),
            "udp_profile_lidar is FIVE_WORD_PIXEL; supported are LEGACY, RNG19_RFL8_SIG16_NIR16, "
            "RNG19_RFL8_SIG16_NIR16_DUAL, RNG15_RFL8_NIR8");
  EXPECT_EQ(said("_column\": 16", "_column\": 17"),
            "beam_altitude_angles is a list of 16, but must be a list of 17 numbers");
  EXPECT_EQ(said("_column\": 16", "_column\": 0"),
            "pixels_per_column is 0, but must be a whole number from 1 to 256");
  EXPECT_THAT(said("_column\": 16", "_column\": -1"), HasSubstr("pixels_per_column is -1"));
  EXPECT_THAT(said("_column\": 16", "_column\": 1.5"), HasSubstr("pixels_per_column is 1.5"));
  EXPECT_THAT(said("_packet\": 16", "_packet\": 65"), HasSubstr("columns_per_packet is 65"));
  EXPECT_THAT(said("_frame\": 64", "_frame\": 1000000000"), HasSubstr("columns_per_frame is 1000000000"));
  EXPECT_THAT(said("21.500000", "\"a\""), HasSubstr("beam_altitude_angles is \"a\", but must be a number"));
  EXPECT_THAT(said("21.500000", "1e300"), HasSubstr("beam_altitude_angles is 1e+300"));
  EXPECT_THAT(said("lidar_to_sensor_transform", "transform"), HasSubstr("has no lidar_to_sensor_transform"));
  EXPECT_THAT(said("beam_altitude_angles", "angles"), HasSubstr("has no beam_altitude_angles"));
  EXPECT_THAT(said("beam_azimuth_angles", "angles"), HasSubstr("has no beam_azimuth_angles"));
}

TEST(OusterMetadata, CutAnywhereIsRefused) {
  for (const bool nested : {false, true}) {
    const MadeOuster s = made_ouster("LEGACY");
    const std::string good = nested ? nested_metadata(s) : flat_metadata(s);
    for (std::size_t size = 0; size + 2 < good.size(); ++size)
      EXPECT_THROW(parse_ouster_metadata(good.substr(0, size)), IoError) << size;
    EXPECT_NO_THROW(parse_ouster_metadata(good));
  }
}

}  // namespace
}  // namespace pcl_bv::detail
