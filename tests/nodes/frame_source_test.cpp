// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/frame_source.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/pcd.h"
#include "pcl_bv/synth/synth.h"

namespace pcl_bv {
namespace {

class Folder : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() / ("pcl_bv_source_" + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  void TearDown() override { std::filesystem::remove_all(path_); }

  void add(const std::string& name, std::size_t points) {
    write_pcd(path_ / name, to_raw_cloud(make_synth(parse_synth("gauss:" + std::to_string(points)))));
  }

  std::filesystem::path path_;
};

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

TEST_F(Folder, GivesItsCloudsInNaturalOrderWithTheRatesStamps) {
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

TEST_F(Folder, NamesAFrameThatCannotBeReadAndGoesOn) {
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

TEST_F(Folder, TakesStampsFromNamesIfAsked) {
  add("1000000000.5.pcd", 3);
  add("nothing.pcd", 3);
  const auto source = open_source(path_, {10, true});
  Frame frame;
  EXPECT_TRUE(next(*source, frame));
  EXPECT_EQ(frame.header.stamp_ns, 1'000'000'000'500'000'000);
  EXPECT_THROW(next(*source, frame), FrameError);
  EXPECT_FALSE(next(*source, frame));
}

TEST_F(Folder, WithoutACloudIsAnError) {
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

TEST(FunctionSource, EndsWhenTheFunctionSaysSo) {
  int calls = 0;
  const auto source = make_source([&](Frame& frame) {
    frame.header.seq = 5;
    return ++calls < 3;
  });
  Frame frame;
  EXPECT_TRUE(next(*source, frame));
  EXPECT_TRUE(next(*source, frame));
  EXPECT_FALSE(next(*source, frame));
}

}  // namespace
}  // namespace pcl_bv
