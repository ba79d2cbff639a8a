// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// bv_stream with several sensors, on the recording of `synth rig`.

#include <gmock/gmock.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "command.h"

namespace pcl_bv::test {
namespace {

using testing::HasSubstr;

class Rig : public PcdBv {
 protected:
  Result stream(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--rate", "max", "--volume", "aabb"});
    Surroundings surroundings;
    surroundings.program = "bv_stream";
    return run(arguments, surroundings);
  }

  std::string drive(std::size_t frames = 6) const {
    Surroundings surroundings;
    surroundings.program = "synth";
    const Result made = run({"rig:" + std::to_string(frames), at("rig.mcap")}, surroundings);
    EXPECT_EQ(made.status, 0) << made.err;
    return at("rig.mcap");
  }

  static std::vector<Json> lines(const Result& result) {
    std::vector<Json> all;
    std::istringstream text(result.out);
    for (std::string line; std::getline(text, line);)
      all.push_back(Json::parse(line));
    return all;
  }
};

TEST_F(Rig, IsRecordedWithoutAnyOtherFileAndOverAnOldOneOnlyAsAWhole) {
  const std::string recording = drive(1);
  const auto entries = [&] {
    return std::distance(std::filesystem::directory_iterator(std::filesystem::path(recording).parent_path()),
                         std::filesystem::directory_iterator());
  };
  const auto files = entries();
  std::filesystem::resize_file(recording, 3);
  drive(1);
  EXPECT_GT(std::filesystem::file_size(recording), 1000U);
  EXPECT_EQ(entries(), files);
}

TEST_F(Rig, MergesAllTopicsOfARecordingWithItsTransforms) {
  const Result result = stream({"--source", drive(), "--target-frame", "base_link", "--fixed-frame", "odom",
                                "--deskew", "on", "--track"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  const std::vector<Json> frames = lines(result);
  ASSERT_EQ(frames.size(), 6U);
  for (const Json& frame : frames) {
    EXPECT_EQ(frame["frame_id"], "base_link");
    EXPECT_EQ(frame["sensors"][0]["name"], "/front/points");
    EXPECT_EQ(frame["sensors"][0]["points"], frame["sensors"][1]["points"]);
    EXPECT_EQ(frame["sensors"][1]["stamp_ns"].get<std::int64_t>() - frame["stamp_ns"].get<std::int64_t>(),
              30'000'000);
  }
  EXPECT_EQ(frames[0].count("deskew"), 0U);  // no motion yet
  EXPECT_EQ(frames[5]["deskew"], "poses");
}

TEST_F(Rig, TakesPosesFromAFileOrAUrdfInsteadOfTransforms) {
  const std::string config = file("rig.yaml", R"(
rig:
  frame: robot
  sensors:
    - {topic: /front/points, pose: [1.5, 0.3, 0.9, 0, 0.03, 0.1]}
    - {topic: /rear/points, frame: back}
  urdf: )" + at("robot.urdf") + "\n");
  file("robot.urdf", R"(<robot name="r">
  <link name="robot"><collision><geometry><box size="3 2 4"/></geometry></collision></link>
  <link name="back"/>
  <joint name="j" type="fixed"><parent link="robot"/><child link="back"/><origin xyz="-1.2 -0.2 1.1" rpy="0 0 3.0915926535897931"/></joint>
</robot>)");
  const std::string recording = drive(2);
  const Result own = stream({"--source", recording, "--config", config}),
               recorded = stream({"--source", recording, "--target-frame", "base_link"});
  EXPECT_EQ(own.status, 0) << own.err;
  const std::vector<Json> a = lines(own), b = lines(recorded);
  ASSERT_EQ(a.size(), 2U);
  EXPECT_EQ(a[1]["frame_id"], "robot");
  ASSERT_EQ(a[1]["clusters"].size(), b[1]["clusters"].size());
  for (std::size_t i = 0; i < a[1]["clusters"].size(); ++i)
    EXPECT_NEAR(a[1]["clusters"][i]["volumes"][0]["min"][0].get<double>(),
                b[1]["clusters"][i]["volumes"][0]["min"][0].get<double>(), 1e-4);
  // The body of the robot, larger than it is, drops points of the ground around it.
  const Result filtered = stream({"--source", recording, "--config", config, "--self-filter", "3"});
  EXPECT_EQ(lines(own)[1]["counts"]["inside"], 0);
  EXPECT_GT(lines(filtered)[1]["counts"]["inside"].get<int>(), 100);
}

TEST_F(Rig, IsNotedWithTheOtherSettingsInARecordingOfItsResults) {
  const Result result = stream({"--source", drive(2), "--target-frame", "base_link", "--sync", "40",
                                "--queue", "9", "--sink", "rosbag2:" + at("bag")});
  ASSERT_EQ(result.status, 0) << result.err;
  const Result again = stream({"--source", at("rig.mcap"), "--config", at("bag/config.yaml")});
  EXPECT_EQ(again.status, 0) << again.err;
  ASSERT_EQ(lines(again).size(), 2U);
  EXPECT_EQ(lines(again)[1]["frame_id"], "base_link");
  const std::string noted = read_file(at("bag/config.yaml"));
  EXPECT_THAT(noted, HasSubstr("sync_ms: 40"));
  EXPECT_THAT(noted, HasSubstr("queue: 9"));
}

TEST_F(Rig, EndsWithStatus1IfASensorHasNoTransform) {
  const Result result = stream({"--source", drive(2), "--target-frame", "moon"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("no pose in moon: no transform names the frame moon"));
  EXPECT_EQ(lines(result)[0].count("error"), 1U);
}

TEST_F(Rig, RejectsWhatCannotBeMerged) {
  const std::string recording = drive(1);
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    const Result result = stream(std::move(arguments));
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(why));
  };
  refused({"--source", recording, "--source", recording}, "--source: several sources need --target-frame");
  refused({"--source", recording, "--source", "synth:street-sequence", "--target-frame", "a"},
          "no common stamps");
  refused({"--source", recording, "--fixed-frame", "odom"}, "--fixed-frame: needs --target-frame");
  refused({"--source", recording, "--target-frame", "a", "--loop", "2"}, "--loop: not with --target-frame");
  refused({"--source", recording, "--target-frame", "a", "--self-filter", "0.1"},
          "--self-filter: needs --urdf");
  refused({"--source", recording, "--config", file("r.yaml", "rig: {frame: a, sensors: [{topic: /none}]}\n")},
          "rig.sensors: no source has the topic /none");
  refused({"--source", recording, "--target-frame", "a", "--odometry", "/odom"},
          "--odometry: needs --fixed-frame");
  refused({"--source", recording, "--target-frame", "a", "--fixed-frame", "b", "--odometry", "/tf"},
          "rig.odometry: no recording has the topic /tf of type nav_msgs/msg/Odometry");
  refused({"--source", recording, "--config",
           file("p.yaml", "rig: {frame: a, sensors: [{topic: /x, pose: [1, 2]}]}\n")},
          "line 1: rig.sensors: the pose of /x is not x, y, z, roll, pitch, yaw");
  const Result missing = stream({"--source", recording, "--target-frame", "a", "--urdf", at("none.urdf")});
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.err, HasSubstr("none.urdf"));
}

}  // namespace
}  // namespace pcl_bv::test
