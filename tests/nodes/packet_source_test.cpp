// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../recording/made_ouster.h"
#include "../recording/made_packets.h"
#include "folder.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/nodes/frame_source.h"
#include "stream/sources/recorded_clouds.h"

namespace pcl_bv::detail {
namespace {

class PacketSource : public Folder {
 protected:
  // A little of one revolution, a whole one, and a little of the next.
  std::string record() {
    std::vector<std::string> payloads;
    for (unsigned azimuth = 35'000; azimuth < 35'000 + 38'000; azimuth += 480)
      payloads.push_back(packet(azimuth % 36'000, 40, 0x37, 0x22));
    write("a.pcap", pcap(payloads));
    return (path_ / "a.pcap").string();
  }
};

std::vector<Frame> frames_of(FrameSource& source) {
  std::vector<Frame> frames;
  for (Frame frame; source.next(frame, std::chrono::milliseconds(1000)) == Next::frame;)
    frames.push_back(frame);
  return frames;
}

TEST_F(PacketSource, GivesAFrameForEachRevolution) {
  ReplayOptions options;
  options.own_stamps = true;
  options.loops = 2;
  const std::vector<Frame> frames = frames_of(*open_source(record(), options));
  ASSERT_EQ(frames.size(), 6U);
  EXPECT_EQ(frames[0].header.stamp_ns, 100'000'000'000);
  EXPECT_GT(frames[1].header.stamp_ns, frames[0].header.stamp_ns);
  EXPECT_EQ(frames[3].header.stamp_ns, frames[0].header.stamp_ns);
  EXPECT_EQ(frames[5].header.seq, 5U);
  EXPECT_EQ(frames[2].pass, 0U);
  EXPECT_EQ(frames[3].pass, 1U);
  EXPECT_EQ(frames[1].header.frame_id, "velodyne");
  EXPECT_GT(frames[1].points.count, 28'000U);
  EXPECT_NEAR(load_point(frames[1].points, 0).y, 2 * std::cos(15 * 3.14159265358979 / 180), 0.1);
}

TEST_F(PacketSource, GivesTheTimesOfTheRateAndCountsPoses) {
  ReplayOptions options;
  options.rate_hz = 5;
  const std::string file = record();
  EXPECT_EQ(frames_of(*open_source(file, options))[2].header.stamp_ns, 400'000'000);
  write("poses.txt", "1 0 0 5 0 1 0 0 0 0 1 0\n1 0 0 6 0 1 0 0 0 0 1 0\n");
  options.poses = path_ / "poses.txt";
  EXPECT_THROW(open_source(file, options), IoError);  // two for three frames
}

TEST_F(PacketSource, HasNeitherTopicsNorClasses) {
  ReplayOptions options;
  options.topic = "/points";
  EXPECT_THROW(open_source(record(), options), std::invalid_argument);
  options = {};
  options.class_field = "label";
  EXPECT_THROW(open_source(record(), options), std::invalid_argument);
}

TEST_F(PacketSource, GivesTheFramesOfAnOusterWithItsMetadata) {
  const MadeOuster sensor = made_ouster("RNG19_RFL8_SIG16_NIR16", 32);
  std::vector<std::string> packets;
  for (unsigned frame = 0; frame < 3; ++frame) {
    for (const std::string& packet :
         packets_of_frame(sensor, frame, random_columns(sensor, 1'000'000, frame)))
      packets.push_back(packet);
  }
  write("a.pcap", pcap(packets));
  const std::string file = (path_ / "a.pcap").string();
  ReplayOptions options;
  options.own_stamps = true;
  try {
    open_source(file, options);
    FAIL();
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::StartsWith(file + ": no packet that can be decoded"),
                                             testing::EndsWith(".json file next to the capture, as a.json")));
  }
  write("a.json", nested_metadata(sensor));
  const std::vector<Frame> frames = frames_of(*open_source(file, options));
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].header.frame_id, "os_sensor");
  EXPECT_EQ(frames[1].header.stamp_ns, 100'000'000'000 + 4 * 1'327'000);
  EXPECT_GT(frames[1].points.count, 1000U);
  ASSERT_TRUE(frames[1].times && frames[1].intensity);
  EXPECT_EQ(frames[1].times->number(frames[1].points.count - 1), 63 * 97'656);
  RecordedClouds clouds(file, {});
  EXPECT_EQ(clouds.count(), 3U);
  EXPECT_EQ(clouds.load(1).size(), frames[1].points.count);
}

TEST_F(PacketSource, SaysWhereTheCaptureIsCut) {
  const std::string file = record();
  std::string bytes = read("a.pcap");
  bytes.resize(bytes.size() - 5);
  write("a.pcap", bytes);
  const auto source = open_source(file);
  EXPECT_EQ(frames_of(*source).size(), 3U);
  EXPECT_THAT(source->take_warnings(),
              testing::ElementsAre(testing::StartsWith("the file ends within a packet, at byte ")));
}

}  // namespace
}  // namespace pcl_bv::detail
