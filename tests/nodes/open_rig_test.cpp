// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rigs by the names of their sources.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../recording/made_packets.h"
#include "folder.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/recording/mcap_writer.h"

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

class OpenRig : public Folder {
 protected:
  // Records a cloud of one point, (1, 0, 0), in the topic /points.
  std::string record(const std::string& name) const {
    const std::string file = (path_ / name).string();
    McapWriter writer(file);
    const float xyz[] = {1, 0, 0};
    msg::PointCloud2 cloud;
    cloud.header = {msg::time_of(5'000'000'000), "lidar"};
    cloud.width = 1;
    cloud.point_step = sizeof xyz;
    cloud.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
    cloud.data = {reinterpret_cast<const std::byte*>(xyz), sizeof xyz};
    std::vector<std::byte> bytes;
    write_cdr(cloud, bytes);
    const std::size_t topic =
        writer.add_topic({"/points", msg::PointCloud2::ros_type, schema_of(msg::PointCloud2::ros_type), {}});
    writer.write(topic, 5'000'000'000, 0, bytes.data(), bytes.size());
    writer.close();
    return file;
  }

  static std::string refusal(const std::vector<std::string>& sources, const RigConfig& rig,
                             const ReplayOptions& options = {}) {
    try {
      open_rig(sources, rig, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  }
};

RigConfig rig_with(std::vector<RigSensor> sensors) {
  RigConfig rig;
  rig.frame = "base";
  rig.sensors = std::move(sensors);
  return rig;
}

TEST_F(OpenRig, WantsARowForEachSourceThatHasTheTopic) {
  const std::string front = record("front.mcap"), rear = record("rear.mcap");
  EXPECT_EQ(refusal({front, rear}, rig_with({{"/points", "", {0, 0, 1, 0, 0, 0}}})),
            "rig.sensors: " + front + " and " + rear +
                " have the topic /points; give each of them a row with `source`");
  const auto source = open_rig({front, rear}, rig_with({{"/points", "", {10, 0, 0, 0, 0, 0}, front},
                                                        {"/points", "", {20, 0, 0, 0, 0, 0}, rear}}));
  Frame frame;
  ASSERT_EQ(source->next(frame, std::chrono::milliseconds(1000)), Next::frame);
  ASSERT_EQ(frame.points.count, 2U);
  EXPECT_EQ(load_point(frame.points, 0).x, 11);
  EXPECT_EQ(load_point(frame.points, 1).x, 21);
}

TEST_F(OpenRig, HasTheStampsOfItsRecordings) {
  ReplayOptions options;
  options.own_stamps = false;
  const auto source = open_rig({record("a.mcap")}, rig_with({{"/points", "", {0, 0, 1, 0, 0, 0}}}), options);
  Frame frame;
  ASSERT_EQ(source->next(frame, std::chrono::milliseconds(1000)), Next::frame);
  EXPECT_EQ(frame.header.stamp_ns, 5'000'000'000);
}

TEST_F(OpenRig, RefusesWhatItCannotMerge) {
  const std::string recording = record("a.mcap");
  ReplayOptions options;
  options.frame_id = "base";
  EXPECT_THAT(refusal({recording}, rig_with({}), options), HasSubstr("no options.frame_id"));
  options = {};
  options.loops = 2;
  EXPECT_THAT(refusal({recording}, rig_with({}), options), HasSubstr("cannot be repeated"));
  EXPECT_THAT(refusal({recording, "synth:street-sequence"}, rig_with({})), HasSubstr("no common stamps"));
}

TEST_F(OpenRig, HasASensorForEachAddressInACapture) {
  std::vector<std::pair<std::uint8_t, std::string>> packets;
  for (unsigned azimuth = 0; azimuth < 80'000; azimuth += 480)
    for (const std::uint8_t address : {std::uint8_t{201}, std::uint8_t{202}})
      packets.emplace_back(address, packet(azimuth % 36'000, 40, 0x37, 0x22));
  write("two.pcap", pcap_of(packets));
  const std::string capture = (path_ / "two.pcap").string();
  const auto source = open_rig({capture}, rig_with({{"192.168.1.201:2368", "", {0, 0, 100, 0, 0, 0}},
                                                    {"192.168.1.202:2368", "", {0, 0, 200, 0, 0, 0}}}));
  Frame frame;
  ASSERT_EQ(source->next(frame, std::chrono::milliseconds(1000)), Next::frame);
  ASSERT_EQ(frame.sensors.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const SensorPart& part = frame.sensors[k];
    ASSERT_GT(part.count, 0U) << part.name;
    EXPECT_NEAR(load_point(frame.points, part.first).z, k == 0 ? 100 : 200, 10) << part.name;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
