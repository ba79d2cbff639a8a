// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The node between ROS's own commands.

#include <gmock/gmock.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>

#include "pcl_bv/recording/recording.h"
#include "ros1_test.h"

namespace pcl_bv::test {
namespace {

using sensor_msgs::PointCloud2;
using visualization_msgs::MarkerArray;

constexpr int kClouds = 12;

class Ros1Commands : public Ros1Test {
 protected:
  // A bag of clouds a tenth of a second apart, each stamped with its number.
  void record_clouds(const std::string& bag) {
    const auto recorder = command("record", {"rosbag", "record", "-O", bag, "points"});
    const Lidar lidar(ros());
    ASSERT_TRUE(lidar.heard()) << recorder->errors();
    for (int i = 1; i <= kClouds; ++i) {
      lidar.send(cube(static_cast<std::uint32_t>(i)));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    recorder->end(SIGINT);
    ASSERT_TRUE(wait_for([&] { return std::filesystem::exists(bag); }));  // until then it has another name
  }
};

TEST_F(Ros1Commands, ABagIsPlayedThroughTheNodeIntoAnother) {
  record_clouds(at("in.bag"));
  const auto running = node({"_ground/method:=none", "_volumes:=aabb,dop26"});
  const auto recorder = command("record2", {"rosbag", "record", "-O", at("out.bag"), "/markers", "/labels"});
  Heard<MarkerArray> markers(ros(), "markers");
  ASSERT_TRUE(wait_for([&] { return markers.connected(); }));
  const auto player = command("play", {"rosbag", "play", "--quiet", "--delay", "1", at("in.bag")});
  EXPECT_EQ(player->wait(), 0) << player->errors();
  EXPECT_TRUE(wait_for([&] { return markers.size() >= kClouds; })) << markers.size();
  recorder->end(SIGINT);
  ASSERT_TRUE(wait_for([&] { return std::filesystem::exists(at("out.bag")); })) << recorder->errors();
  std::map<std::string, int> count;
  const auto recording = open_recording(at("out.bag"));
  RecordedMessage message;
  while (recording->next(message))
    ++count[recording->topics()[message.topic].name];
  EXPECT_EQ(count, (std::map<std::string, int>{{"/labels", kClouds}, {"/markers", kClouds}}));
}

TEST_F(Ros1Commands, TopicToolsRelayBothEnds) {
  const auto running = node({"_ground/method:=none", "_volumes:=aabb"});
  const auto in = command("relay_in", {"/usr/lib/topic_tools/relay", "raw", "points", "__name:=relay_in"});
  const auto out = command("relay_out", {"/usr/lib/topic_tools/throttle", "messages", "markers", "20", "slow",
                                         "__name:=relay_out"});
  Heard<MarkerArray> slow(ros(), "slow");
  const Lidar lidar(ros(), "raw");
  ASSERT_TRUE(lidar.heard());
  EXPECT_TRUE(wait_for([&] {
    lidar.send(cube());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return slow.size() > 2;
  }));
}

TEST_F(Ros1Commands, EitherSideMayDieAndComeBack) {
  record_clouds(at("in.bag"));
  const std::vector<std::string> play{"rosbag", "play", "--quiet", "--loop", at("in.bag")};
  auto running = node({"_ground/method:=none", "_volumes:=aabb"});
  auto player = command("play", play);
  Heard<MarkerArray> markers(ros(), "markers");
  const auto comes_through = [&] {
    const std::size_t before = markers.size();
    return wait_for([&] { return markers.size() > before + 1; });
  };
  ASSERT_TRUE(comes_through());
  player->end(SIGKILL);
  player = command("play2", play);
  EXPECT_TRUE(comes_through());
  EXPECT_EQ(running->end(SIGKILL), 128 + SIGKILL);
  running = node({"_ground/method:=none", "_volumes:=aabb"});
  EXPECT_TRUE(comes_through()) << running->errors();
  EXPECT_EQ(running->end(SIGINT), 0);
}

}  // namespace
}  // namespace pcl_bv::test
