// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_source.h"

#include <gtest/gtest.h>
#include <fstream>
#include <future>

#include "folder.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/synth/verges.h"

namespace pcl_bv {
namespace {

using FolderSource = Folder;

constexpr std::chrono::milliseconds kPatience{20'000};

bool next(FrameSource& source, Frame& frame) {
  const Next next = source.next(frame, kPatience);
  EXPECT_NE(next, Next::nothing);
  return next == Next::frame;
}

TEST(StampInName, ReadsTimesAndNoFrameNumbers) {
  EXPECT_EQ(stamp_in_name("1317384506400000000"), 1'317'384'506'400'000'000);
  EXPECT_EQ(stamp_in_name("n015__LIDAR_TOP__1532402927647951.pcd"), 1'532'402'927'647'951'000);
  EXPECT_EQ(stamp_in_name("1317384506.25"), 1'317'384'506'250'000'000);
  EXPECT_EQ(stamp_in_name("lidar-12.000000001"), 12'000'000'001);
  EXPECT_EQ(stamp_in_name("12.1234567899"), 12'123'456'789);
  EXPECT_EQ(stamp_in_name("a.1317384506400000000"), 1'317'384'506'400'000'000);
  EXPECT_EQ(stamp_in_name("1000000000000000"), 1'000'000'000'000'000'000);
  EXPECT_EQ(stamp_in_name("10000000000000000"), 10'000'000'000'000'000);
  for (const char* number : {"000000", "sweep_000012", "a.5", "999999999999999"})
    EXPECT_EQ(stamp_in_name(number), -1) << number;
  EXPECT_EQ(stamp_in_name("sweep"), -1);
  EXPECT_EQ(stamp_in_name(""), -1);
  EXPECT_EQ(stamp_in_name("99999999999999999999"), -1);
  EXPECT_EQ(stamp_in_name("99999999999.5"), -1);
}

TEST_F(FolderSource, GivesItsCloudsInNaturalOrderWithTheRatesStamps) {
  add("frame10.pcd", 10);
  add("frame9.pcd", 9);
  add("frame1.pcd", 1);
  const auto source = open_source(path_, {20, false, 0, 2});
  Frame frame;
  std::vector<std::size_t> sizes;
  for (std::uint64_t seq = 0; next(*source, frame); ++seq) {
    EXPECT_EQ(frame.header.seq, seq);
    EXPECT_EQ(frame.header.stamp_ns, static_cast<std::int64_t>(seq) * 50'000'000);
    EXPECT_GT(frame.decode_ms, 0);
    sizes.push_back(frame.points.count);
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{1, 9, 10, 1, 9, 10}));
}

TEST_F(FolderSource, NamesAFrameThatCannotBeReadAndGoesOn) {
  add("1.pcd", 3);
  std::ofstream(path_ / "2.pcd") << "no cloud";
  add("3.pcd", 5);
  const auto source = open_source(path_);
  Frame frame;
  EXPECT_TRUE(next(*source, frame));
  try {
    next(*source, frame);
    FAIL();
  } catch (const FrameError& error) {
    EXPECT_EQ(error.frame.header.seq, 1U);
    EXPECT_EQ(error.frame.file, path_ / "2.pcd");
    EXPECT_EQ(std::string(error.what()), error.frame.file + ": " + error.reason);
    EXPECT_NE(std::string(error.what()).find("2.pcd: "), std::string::npos);
  }
  EXPECT_TRUE(next(*source, frame));
  EXPECT_EQ(frame.points.count, 5U);
  EXPECT_FALSE(next(*source, frame));
}

TEST_F(FolderSource, TakesStampsFromNamesIfAsked) {
  add("1000000000.5.pcd", 3);
  add("nothing.pcd", 3);
  const auto source = open_source(path_, {10, true});
  Frame frame;
  EXPECT_TRUE(next(*source, frame));
  EXPECT_EQ(frame.header.stamp_ns, 1'000'000'000'500'000'000);
  EXPECT_THROW(next(*source, frame), FrameError);
  EXPECT_FALSE(next(*source, frame));
}

TEST_F(FolderSource, RefusesStampsFromNamesThatCountFrames) {
  add("000000.pcd", 3);
  add("000001.pcd", 3);
  EXPECT_THROW(open_source(path_, {10, true}), std::invalid_argument);
  EXPECT_THROW(open_source("synth:street-sequence:1", {10, true}), std::invalid_argument);
}

TEST_F(FolderSource, NamesFilesAndTheirCoordinateFrame) {
  add("1.pcd", 3);
  ReplayOptions options;
  options.frame_id = "lidar_top";
  Frame frame;
  ASSERT_TRUE(next(*open_source(path_, options), frame));
  EXPECT_EQ(frame.header.frame_id, "lidar_top");
  EXPECT_EQ(frame.file, path_ / "1.pcd");
  EXPECT_FALSE(frame.pose);
}

TEST_F(FolderSource, WithoutACloudIsAnError) {
  EXPECT_THROW(open_source(path_), IoError);
  EXPECT_THROW(open_source(path_ / "missing"), IoError);
  EXPECT_THROW(open_source("synth:nothing"), std::invalid_argument);
  EXPECT_THROW(open_source(path_, {0, false}), std::invalid_argument);
}

TEST(SynthSource, GivesTheFramesOfTheSequence) {
  const auto source = open_source("synth:street-sequence:2:7", {10, false, 0, 2});
  Frame frame;
  std::vector<float> first;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(next(*source, frame));
    EXPECT_EQ(frame.points.count, 128'000U);
    const float x = static_cast<float>(load_point(frame.points, 90'000).x);
    if (i < 2) first.push_back(x);
    EXPECT_EQ(x, first[static_cast<std::size_t>(i) % 2]);
  }
  EXPECT_FALSE(next(*source, frame));
}

TEST(SynthSource, GivesTheRoadWithVergesAsManyBeamsSeeItAndItsPoses) {
  const auto source = open_source("synth:verges-sequence-16:2:7");
  for (std::size_t i = 0; i < 2; ++i) {
    Frame frame;
    ASSERT_TRUE(next(*source, frame));
    const VergesFrame made = make_verges_frame({7, 16}, i);
    ASSERT_EQ(frame.points.count, made.cloud.size());
    EXPECT_EQ(frame.header.frame_id, "verges");
    for (std::size_t point = 0; point < made.cloud.size(); point += 1000)
      EXPECT_EQ(load_point(frame.points, point).x, made.cloud.xyz[3 * point]);
    ASSERT_TRUE(frame.pose);
    for (Eigen::Index k = 0; k < 12; ++k)
      EXPECT_EQ((*frame.pose)(k / 4, k % 4), made.pose[static_cast<std::size_t>(k)]);
  }
  EXPECT_THROW(open_source("synth:verges-sequence-17"), std::invalid_argument);
}

TEST_F(FolderSource, GivesPosesInPlaceOfTheVergesOwn) {
  write("poses.txt", "1 0 0 5 0 1 0 6 0 0 1 7\n");
  ReplayOptions options;
  options.poses = path_ / "poses.txt";
  Frame frame;
  ASSERT_TRUE(next(*open_source("synth:verges-sequence-16:1", options), frame));
  ASSERT_TRUE(frame.pose);
  EXPECT_EQ(frame.pose->translation(), Eigen::Vector3d(5, 6, 7));
}

TEST(FunctionSource, EndsWhenTheFunctionSaysSo) {
  int calls = 0;
  const auto source = make_source([&](Frame& frame) {
    frame.header.seq = 5;
    return ++calls < 3;
  });
  Frame frame;
  EXPECT_TRUE(next(*source, frame));
  EXPECT_EQ(frame.header.seq, 5U);
  EXPECT_TRUE(next(*source, frame));
  EXPECT_FALSE(next(*source, frame));
  EXPECT_EQ(calls, 3);
}

TEST(FunctionSource, ASilentOneIsNotWaitedFor) {
  struct Shared {
    std::promise<void> begun, speak, spoken;
    int calls = 0;
  };
  const auto shared = std::make_shared<Shared>();
  auto source = make_source([shared](Frame&) {
    if (++shared->calls < 2) return true;
    shared->begun.set_value();
    shared->speak.get_future().wait();
    shared->spoken.set_value();
    return true;
  });
  Frame frame;
  ASSERT_TRUE(next(*source, frame));
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(source->next(frame, std::chrono::milliseconds(1)), Next::nothing);
  shared->begun.get_future().wait();
  source.reset();
  shared->speak.set_value();
  shared->spoken.get_future().wait();
  EXPECT_EQ(shared->calls, 2);  // called once, however often it was asked for
}

TEST(FunctionSource, ItsExceptionsCostTheirFramesOnly) {
  int calls = 0;
  const auto source = make_source([&](Frame& frame) {
    if (++calls == 1) throw FrameError(frame, "dust");
    if (calls == 2) throw std::runtime_error("unplugged");
    return true;
  });
  Frame frame;
  EXPECT_THROW(next(*source, frame), FrameError);
  try {
    next(*source, frame);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "unplugged");
  }
  EXPECT_TRUE(next(*source, frame));
}

TEST(SourceKinds, AreListedForUsers) {
  EXPECT_EQ(source_syntax(),
            "A folder of clouds, one file\nor a recording (.mcap, .bag, .db3 or its folder)\nor packets of a Velodyne (.pcap, .pcapng)\nor dds:TOPIC of ROS 2 (sensor_msgs/msg/PointCloud2)\nor synth:street-sequence[:FRAMES[:SEED]]\n"
            "or synth:verges-sequence[-BEAMS][:FRAMES[:SEED]]");
}

}  // namespace
}  // namespace pcl_bv
