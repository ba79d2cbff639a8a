// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Poses of recordings, with answers worked out by hand.

#include <gtest/gtest.h>

#include "folder.h"
#include "german_locale.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/nodes/frame_source.h"

namespace pcl_bv::detail {
namespace {

class Poses : public Folder {
 protected:
  std::vector<std::optional<Pose>> of_frames(const std::string& poses, bool own_stamps = false) {
    write("poses.txt", poses);
    ReplayOptions options{10, own_stamps};
    options.poses = path_ / "poses.txt";
    const auto source = open_source(path_, options);
    std::vector<std::optional<Pose>> all;
    Frame frame;
    while (source->next(frame, std::chrono::seconds(20)) == Next::frame)
      all.push_back(frame.pose);
    return all;
  }
};

void expect_maps(const Pose& pose, const Eigen::Vector3d& point, const Eigen::Vector3d& to) {
  EXPECT_LT((pose * point - to).norm(), 1e-12) << (pose * point).transpose();
}

// 10 m ahead and a quarter turn about the camera's y, which points down: to the right.
constexpr const char* kAheadAndRight = "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 1 0 0 1 0 0 -1 0 0 10\n";

TEST_F(Poses, OfKittiBelongToFramesByTheirNumber) {
  add("0.pcd", 3);
  add("1.pcd", 3);
  const auto poses = of_frames(kAheadAndRight);
  ASSERT_EQ(poses.size(), 2U);
  expect_maps(*poses[0], {1, 2, 3}, {1, 2, 3});
  expect_maps(*poses[1], {0, 0, 0}, {0, 0, 10});
  expect_maps(*poses[1], {1, 0, 0}, {0, 0, 9});
}

TEST_F(Poses, OfKittisCameraBecomeThoseOfTheSensor) {
  add("0.pcd", 3);
  add("1.pcd", 3);
  // x ahead, y left, z up become z, -x, -y; the sensor is 0.5 m behind the camera.
  write("calib.txt", "P0: 7 0 0 0 0 7 0 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.5\n");
  const auto poses = of_frames(kAheadAndRight);
  ASSERT_EQ(poses.size(), 2U);
  expect_maps(*poses[0], {1, 2, 3}, {1, 2, 3});
  expect_maps(*poses[1], {0, 0, 0}, {10.5, 0.5, 0});
  expect_maps(*poses[1], {1, 0, 0}, {10.5, -0.5, 0});
  expect_maps(*poses[1], {0, 0, 1}, {10.5, 0.5, 1});
}

TEST_F(Poses, OfTumAreInterpolatedAcrossHalfASecondAtMost) {
  for (const char* name : {"99.9", "100.0", "100.1", "100.6", "101.0", "101.1"})
    add(std::string(name) + ".pcd", 3);
  const auto poses = of_frames(
      "# stamp x y z qx qy qz qw\n\n"
      "100 0 0 0 0 0 0 1\n"
      "1.004e2 4 0 8 0 0 0.7071067811865476 0.7071067811865476\n"
      "101.0 5 6 7 0 0 0 1\n",
      true);
  ASSERT_EQ(poses.size(), 6U);
  EXPECT_FALSE(poses[0]);
  expect_maps(*poses[1], {1, 2, 3}, {1, 2, 3});
  expect_maps(*poses[2], {0, 0, 0}, {1, 0, 2});
  expect_maps(*poses[2], {1, 0, 0}, {1 + 0.92387953251128674, 0.38268343236508977, 2});  // 22.5 degrees
  EXPECT_FALSE(poses[3]);                                                                // in a gap of 0.6 s
  expect_maps(*poses[4], {0, 0, 0}, {5, 6, 7});
  EXPECT_FALSE(poses[5]);
}

TEST_F(Poses, OfTumKnowTodaysNanoseconds) {
  add("1317384506.400000001.pcd", 3);
  EXPECT_TRUE(of_frames("1317384506.400000001 1 2 3 0 0 0 1\n", true)[0]);
  EXPECT_FALSE(of_frames("1317384506.400000002 1 2 3 0 0 0 1\n", true)[0]);
}

TEST_F(Poses, MayHavePlusSignsAndDoNotDependOnTheLocale) {
  add("0.pcd", 3);
  const test::GermanLocale german;
  const auto poses = of_frames("+1 0 0 1.250 0 1 0 +0.5 0 0 1 -2\n");
  EXPECT_EQ(Eigen::Vector3d(poses.at(0).value().translation()), Eigen::Vector3d(1.25, 0.5, -2));
}

TEST_F(Poses, ThatCannotBeUsedAreNamedWithTheirLine) {
  add("0.pcd", 3);
  add("1.pcd", 3);
  const std::string tum = "1 2 3 4 0 0 0 1\n", kitti = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {"", "no poses"},
           {"# nothing\n", "no poses"},
           {kitti, "1 poses of 2 frames"},
           {"1 2 3\n", "line 1: must have 12"},
           {"1 2 3 4 5 6 7 eight\n", "line 1: must have 12"},
           {kitti + tum, "line 2: must have 12"},
           {"1 0 0 0 0 1 0 0 0 0 nan 0\n", "line 1: must have 12"},
           {"1 0 0 0 0 1 0 0 0 0 -1 0\n", "line 1: not a rotation"},
           {"2 0 0 0 0 1 0 0 0 0 1 0\n", "line 1: not a rotation"},
           {"1 2 3 4 0 0 0 0\n", "line 1: not a rotation"},
           {tum + tum, "line 2: not later"},
           {"1e300 2 3 4 0 0 0 1\n", "line 1: not a time"}}) {
    try {
      of_frames(text);
      FAIL() << text;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find("poses.txt: " + what), std::string::npos) << error.what();
    }
  }
  write("calib.txt", "Tr: 1 2 3\n");
  EXPECT_THROW(of_frames(kitti + kitti), IoError);
  ReplayOptions options;
  options.poses = path_ / "missing";
  EXPECT_THROW(open_source(path_, options), IoError);
}

std::string kitti_poses(int count) {
  std::string lines;
  for (int i = 0; i < count; ++i)
    lines += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
  return lines;
}

TEST_F(Poses, OfKittiAreMatchedByTheNumbersInTheNamesIfFramesAreMissing) {
  for (const auto& names :
       std::vector<std::vector<std::string>>{{"000001.pcd", "000004.pcd", "000010.pcd"},
                                             {"v2_scan_1.pcd", "v2_scan_4.pcd", "v2_scan_10.pcd"},
                                             {"left1.pcd", "left4.pcd", "right10.pcd"}}) {
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      std::filesystem::remove(entry);
    for (const std::string& name : names)
      add(name, 3);
    write("poses.txt", kitti_poses(11));
    ReplayOptions options{10, false, 0, 2};  // twice
    options.poses = path_ / "poses.txt";
    const auto source = open_source(path_, options);
    EXPECT_EQ(source->take_warnings(), (std::vector{(path_ / "poses.txt").string() +
                                                    ": 11 poses of 3 frames: matched by the numbers in the "
                                                    "file names, 1 to 10 (the first pose is number 0)"}));
    EXPECT_TRUE(source->take_warnings().empty());
    Frame frame;
    for (const int x : {1, 4, 10, 1, 4, 10}) {
      ASSERT_EQ(source->next(frame, std::chrono::seconds(20)), Next::frame);
      ASSERT_TRUE(frame.pose);
      EXPECT_EQ(frame.pose->translation().x(), x) << names[0];
    }
  }
}

TEST_F(Poses, OfKittiAreInTheOrderOfTheFramesIfThereAreAsMany) {
  add("4.pcd", 3);
  add("9.pcd", 3);
  const auto poses = of_frames(kitti_poses(2));
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1]->translation().x(), 1);
}

TEST_F(Poses, OfAnotherCountAreRefusedWithoutANumberForEachName) {
  for (const auto& names : std::vector<std::vector<std::string>>{{"1.pcd", "7.pcd"},
                                                                 {"1.pcd", "front.pcd"},
                                                                 {"1_2.pcd", "2_3.pcd"},
                                                                 {"1.5.pcd", "1.6.pcd"},
                                                                 {"a1.pcd", "b1.pcd"},
                                                                 {"12-00-01.pcd", "12-00-02.pcd"}}) {
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      std::filesystem::remove(entry);
    for (const std::string& name : names)
      add(name, 3);
    EXPECT_THROW(of_frames(kitti_poses(7)), IoError) << names[0];
  }
}

TEST_F(Poses, RepeatWithTheirRecording) {
  add("0.pcd", 3);
  write("poses.txt", "1 0 0 5 0 1 0 0 0 0 1 0\n");
  ReplayOptions options{10, false, 0, 2};
  options.poses = path_ / "poses.txt";
  const auto source = open_source(path_ / "0.pcd", options);
  Frame frame;
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(source->next(frame, std::chrono::seconds(20)), Next::frame);
    ASSERT_TRUE(frame.pose);
    expect_maps(*frame.pose, {0, 0, 0}, {5, 0, 0});
  }
}

TEST_F(Poses, ByTimeRepeatWithTheirFolder) {
  add("0.pcd", 3);
  add("1.pcd", 3);
  write("poses.txt", "0 5 0 0 0 0 0 1\n0.1 6 0 0 0 0 0 1\n");
  ReplayOptions options{10, false, 0, 2};
  options.poses = path_ / "poses.txt";
  const auto source = open_source(path_, options);
  Frame frame;
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(source->next(frame, std::chrono::seconds(20)), Next::frame);
    EXPECT_EQ(frame.header.stamp_ns, i * 100'000'000);
    EXPECT_EQ(frame.pass, i / 2);
    ASSERT_TRUE(frame.pose) << i;
    expect_maps(*frame.pose, {0, 0, 0}, {5.0 + i % 2, 0, 0});
  }
}

}  // namespace
}  // namespace pcl_bv::detail
