// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The node with several sensors, whose clouds it merges in the frame of the robot.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cstring>

#include "live_topics.h"
#include "pcl_bv/messages/odometry.h"
#include "pcl_bv/messages/results.h"
#include "pcl_bv/messages/serialize.h"
#include "ros1_test.h"
#include "ros1_writer.h"

namespace pcl_bv::test {
namespace {

using sensor_msgs::PointCloud2;
using testing::HasSubstr;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

msg::TransformStamped step(const std::string& parent, const std::string& child, double x,
                           msg::Time stamp = {}) {
  msg::TransformStamped step;
  step.header = {stamp, parent};
  step.child_frame_id = child;
  step.transform.translation.x = x;
  return step;
}

PointCloud2 stamped(PointCloud2 cloud, std::uint32_t seconds, std::uint32_t nanoseconds) {
  cloud.header.stamp = ::ros::Time(seconds, nanoseconds);
  return cloud;
}

class Ros1Rig : public Ros1Test {
 protected:
  // The node merges /front, whose pose comes from transforms, and /rear, which is 9 m behind.
  std::unique_ptr<Background> rig(const std::string& settings = "",
                                  const std::string& rig_settings = "") const {
    std::ofstream(at("rig.yaml")) << "ground: {method: none}\nvolumes: [aabb]\n"
                                  << settings << "rig:\n  frame: base\n  sync_ms: 300\n"
                                  << rig_settings
                                  << "  sensors:\n    - {topic: /front}\n"
                                     "    - {topic: /rear, frame: back, pose: [-9, 0, 0, 0, 0, 0]}\n";
    return node({"_config:=" + at("rig.yaml")});
  }

  // The centres of the boxes of a frame with two objects.
  static std::vector<double> centres(const MarkerArray& array) {
    std::vector<double> all;
    for (const Marker& marker : array.markers)
      if (marker.action == Marker::ADD) all.push_back(marker.pose.position.x);
    std::sort(all.begin(), all.end());
    return all;
  }

  // Calls `send` with a growing number of seconds until so many frames have the clouds of both sensors.
  // Returns the last one.
  static MarkerArray merged(const Heard<MarkerArray>& markers, std::ptrdiff_t frames,
                            const std::function<void(std::uint32_t)>& send) {
    const auto has_both = [](const MarkerArray::ConstPtr& array) { return centres(*array).size() == 2; };
    std::vector<MarkerArray::ConstPtr> all;
    std::uint32_t seconds = 17;
    EXPECT_TRUE(wait_for([&] {
      send(++seconds);
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      all = markers.all();
      return std::count_if(all.begin(), all.end(), has_both) >= frames;
    }));
    const auto last = std::find_if(all.rbegin(), all.rend(), has_both);
    return last == all.rend() ? MarkerArray() : **last;
  }
};

TEST_F(Ros1Rig, MergesTheCloudsOfItsTopicsInTheFrameOfTheRobot) {
  const Writer fixed = transforms(ros(), "/tf_static");
  fixed.send(msg::TFMessage{{step("base", "lidar", 1)}});  // before the node starts
  const auto running = rig();
  const Heard<MarkerArray> markers(ros(), "markers");
  const Heard<PointCloud2> labels(ros(), "labels");
  const Lidar front(ros(), "/front"), rear(ros(), "/rear");
  ASSERT_TRUE(front.heard() && rear.heard()) << running->errors();
  const MarkerArray found = merged(markers, 1, [&](std::uint32_t seconds) {
    front.send(cube(seconds));
    rear.send(cube(seconds));
  });
  ASSERT_EQ(centres(found).size(), 2U) << running->errors();
  EXPECT_NEAR(centres(found)[0], 1.45, 1e-5);
  EXPECT_NEAR(centres(found)[1], 11.45, 1e-5);
  EXPECT_EQ(found.markers.front().header.frame_id, "base");
  ASSERT_TRUE(wait_for([&] { return labels.size() > 0 && labels.all().back()->width == 2000; }));
  EXPECT_EQ(running->end(SIGINT), 0);
  EXPECT_THAT(running->errors(), testing::Not(HasSubstr("cloud lost")));
}

// The robot drives at 10 m/s. The cloud of /rear is 0.1 s later, in which the cube comes 1 m closer.
TEST_F(Ros1Rig, DeskewsWithThePosesOfTfOrOfOdometry) {
  for (const bool odometry : {false, true}) {
    const Writer moving = transforms(ros(), "/tf");
    const Writer odom(ros(), "/odom", "nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7");
    const auto running = rig("deskew: \"on\"\n",
                             std::string("  fixed_frame: odom\n") + (odometry ? "  odometry: /odom\n" : ""));
    const Heard<MarkerArray> markers(ros(), "markers");
    const Lidar front(ros(), "/front"), rear(ros(), "/rear");
    ASSERT_TRUE(front.heard() && rear.heard() && moving.heard() && (!odometry || odom.heard()))
        << running->errors();
    const auto send_pose = [&](std::uint32_t seconds, std::uint32_t nanoseconds) {
      const double x = 10 * (seconds + 1e-9 * nanoseconds);
      const msg::Time stamp{static_cast<std::int32_t>(seconds), nanoseconds};
      msg::Odometry pose;
      pose.header = {stamp, "odom"};
      pose.child_frame_id = "base";
      pose.pose.pose.position.x = x;
      pose.pose.pose.orientation.w = 1;
      odom.send(pose);
      // With odometry, /tf says that the robot stands still.
      moving.send(
          msg::TFMessage{{step("odom", "base", odometry ? 0 : x, stamp), step("base", "lidar", 1, stamp)}});
    };
    // Motion is known from the second frame on.
    const MarkerArray found = merged(markers, 3, [&](std::uint32_t seconds) {
      for (const std::uint32_t nanoseconds : {0U, 400'000'000U, 800'000'000U})
        send_pose(seconds, nanoseconds);
      front.send(stamped(cube(), seconds, 300'000'000));
      rear.send(stamped(cube(), seconds, 400'000'000));
    });
    ASSERT_EQ(centres(found).size(), 2U) << running->errors();
    EXPECT_NEAR(centres(found)[0], 2.45, 1e-3) << odometry;
    EXPECT_NEAR(centres(found)[1], 11.45, 1e-3) << odometry;
    EXPECT_EQ(running->end(SIGINT), 0);
  }
}

TEST_F(Ros1Rig, ListensToCloudsOnlyWhileSomebodyListens) {
  const Writer moving = transforms(ros(), "/tf");
  const auto running = rig();
  const Lidar front(ros(), "/front"), rear(ros(), "/rear");
  ASSERT_TRUE(moving.heard()) << running->errors();
  for (int again = 0; again < 2; ++again) {
    EXPECT_EQ(front.listeners() + rear.listeners(), 0U);
    Heard<MarkerArray> markers(ros(), "markers");
    EXPECT_TRUE(front.heard() && rear.heard());
    markers.stop();
    EXPECT_TRUE(wait_for([&] { return front.listeners() + rear.listeners() == 0; }));
  }
  EXPECT_EQ(running->end(SIGINT), 0);
}

TEST_F(Ros1Rig, CountsCloudsWithoutATransformAndNamesTheirSensor) {
  const auto running = rig();
  const Heard<MarkerArray> markers(ros(), "markers");
  const Heard<diagnostic_msgs::DiagnosticArray> diagnostics(ros(), "/diagnostics");
  const Lidar front(ros(), "/front"), rear(ros(), "/rear");
  ASSERT_TRUE(front.heard() && rear.heard()) << running->errors();
  std::uint32_t seconds = 17;
  EXPECT_TRUE(wait_for([&] {
    front.send(cube(++seconds));
    rear.send(cube(seconds));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return running->errors().find("cloud lost: ") != std::string::npos && markers.size() > 0;
  })) << running->errors();
  EXPECT_THAT(running->errors(),
              HasSubstr("cloud lost: /front: no pose in base: no transform names the frame lidar"));
  EXPECT_EQ(centres(*markers.all().back()).size(), 1U) << "the other sensor's frames go on";
  EXPECT_TRUE(wait_for([&] {
    const auto all = diagnostics.all();
    return !all.empty() && all.back()->status.front().level == diagnostic_msgs::DiagnosticStatus::WARN;
  }));
  EXPECT_EQ(running->end(SIGINT), 0);
}

TEST_F(Ros1Rig, IgnoresTopicsOfAnotherTypeAndBrokenMessagesWithAWarning) {
  const ::ros::Publisher wrong = ros().advertise<MarkerArray>("/front", 10);
  const Writer broken = transforms(ros(), "/tf");
  const auto running = rig("", "  fixed_frame: odom\n");
  const Heard<MarkerArray> markers(ros(), "markers");
  const Lidar rear(ros(), "/rear");
  ASSERT_TRUE(rear.heard() && broken.heard()) << running->errors();
  std::uint32_t seconds = 17;
  const auto has = [&](const char* text) { return running->errors().find(text) != std::string::npos; };
  EXPECT_TRUE(wait_for([&] {
    wrong.publish(MarkerArray());
    broken.send(msg::Time{1, 2});
    PointCloud2 cut_off = cube(++seconds);
    cut_off.data.resize(5);
    rear.send(cut_off);
    rear.send(cube(++seconds));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return markers.size() > 0 && has("cloud lost: /rear: ") && has("/tf: the message ends within a field") &&
           has("/front: published as visualization_msgs/msg/MarkerArray: messages ignored, expected "
               "sensor_msgs/msg/PointCloud2");
  })) << running->errors();
  EXPECT_EQ(running->end(SIGINT), 0);
}

TEST_F(Ros1Rig, TakesItsParametersFromTheParameterServerAndTheTopicPoints) {
  ros().setParam("/cluster_volumes/rig/frame", "base");
  XmlRpc::XmlRpcValue sensors, pose;
  for (int i = 0; i < 6; ++i)
    pose[i] = i == 0 ? 5 : 0;
  sensors[0]["topic"] = "points";
  sensors[0]["pose"] = pose;
  ros().setParam("/cluster_volumes/rig/sensors", sensors);
  for (const bool with_sensors : {true, false}) {
    const Writer fixed = transforms(ros(), "/tf_static");
    fixed.send(msg::TFMessage{{step("base", "lidar", 7)}});
    const auto running = node({"_ground/method:=none", "_volumes:=aabb"});
    const Heard<MarkerArray> markers(ros(), "markers");
    const Lidar lidar(ros(), "points");
    ASSERT_TRUE(lidar.heard()) << running->errors();
    std::uint32_t seconds = 17;
    EXPECT_TRUE(wait_for([&] {
      lidar.send(cube(++seconds));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      return markers.size() > 0;
    })) << running->errors();
    ASSERT_EQ(markers.all().back()->markers.size(), 1U);
    EXPECT_NEAR(markers.all().back()->markers.front().pose.position.x, with_sensors ? 15.45 : 17.45, 1e-5);
    EXPECT_EQ(running->end(SIGINT), 0);
    ros().deleteParam("/cluster_volumes/rig/sensors");
  }
}

// As between nodelets of one manager, which exchange pointers to messages if both sides have the same type.
TEST_F(Ros1Rig, ReceivesTheBytesOfACloudOfTheSameProcess) {
  LiveTopics topics(ros());
  const auto receiver = topics.receiver(
      "/own", {"livox_ros_driver/msg/CustomMsg", "sensor_msgs/msg/PointCloud2"}, Delivery::newest);
  const Lidar lidar(ros(), "/own");
  topics.subscribe_to_clouds(true);
  ASSERT_TRUE(lidar.heard());
  ReceivedMessage message;
  for (int i = 0; i < 3; ++i)
    lidar.send(cube());
  ASSERT_TRUE(receiver->next(message, std::chrono::seconds(10)));
  EXPECT_EQ(message.type, 1U);
  EXPECT_TRUE(message.ros1);
  const auto cloud = read_message<msg::PointCloud2>(message.data, message.size, message.ros1);
  EXPECT_EQ(cloud.header.frame_id, "lidar");
  ASSERT_EQ(cloud.data.size, 12'000U);
  EXPECT_EQ(std::memcmp(cloud.data.data, cube().data.data(), 12'000), 0);
  EXPECT_THAT(receiver->take_warnings(), testing::IsEmpty());
}

TEST_F(Ros1Rig, RefusesSettingsThatAreNotAllowed) {
  const auto refuses = [&](const std::vector<std::string>& arguments, const std::string& why,
                           int status = 2) {
    const auto running = node(arguments);
    EXPECT_EQ(running->wait(), status) << arguments.back();
    EXPECT_EQ(lines_of(at("node.err")), 1U) << running->errors();
    EXPECT_THAT(running->errors(), HasSubstr(why));
    ros().deleteParam("/cluster_volumes");
  };
  refuses({"_rig/fixed_frame:=odom"}, "rig.fixed_frame: needs rig.frame");
  refuses({"_rig/frame:=base", "_rig/sync_ms:=0"}, "rig.sync_ms: 0 is not above 0");
  refuses({"_rig/frame:=base", "_rig/fixed_frame:=odom", "_rig/odometry:=the odometry"},
          "rig: the odometry: ");
  refuses({"_rig/frame:=base", "_rig/urdf:=" + at("none.urdf")}, "none.urdf", 1);
}

}  // namespace
}  // namespace pcl_bv::test
