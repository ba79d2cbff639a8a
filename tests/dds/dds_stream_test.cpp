// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// bv_stream between the topics of ROS 2.

#include <gmock/gmock.h>
#include <zstd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "dds_test.h"
#include "message_bytes.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/odometry.h"
#include "pcl_bv/messages/results.h"
#include "pcl_bv/messages/serialize.h"
#include "stream/middleware.h"
#include "stream/rig/transform_feed.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

constexpr const char* kCloud = "sensor_msgs/msg/PointCloud2";

Bytes cloud_of(const std::vector<float>& xyz, bool big_endian = false,
               const msg::Header& header = {{17, 5}, "lidar"}) {
  msg::PointCloud2 cloud;
  cloud.header = header;
  cloud.is_bigendian = big_endian;
  for (const char* name : {"x", "y", "z"})
    cloud.fields.push_back(
        {name, static_cast<std::uint32_t>(4 * cloud.fields.size()), msg::PointField::FLOAT32, 1});
  cloud.point_step = 12;
  cloud.width = static_cast<std::uint32_t>(xyz.size() / 3);
  cloud.row_step = 12 * cloud.width;
  cloud.data = {reinterpret_cast<const std::byte*>(xyz.data()), 4 * xyz.size()};
  Bytes bytes;
  write_cdr(cloud, bytes);
  return bytes;
}

// A cube of 1000 points, 1 m wide, 10 m ahead.
Bytes cube(const msg::Header& header = {{17, 5}, "lidar"}) {
  std::vector<float> xyz;
  for (int i = 0; i < 1000; ++i)
    for (const float value : {10 + 0.1F * static_cast<float>(i % 10), 0.1F * static_cast<float>(i / 10 % 10),
                              0.1F * static_cast<float>(i / 100)})
      xyz.push_back(value);
  return cloud_of(xyz, false, header);
}

class Dds : public DdsTest {
 protected:
  /// A file of 1000 points, which are done in time also where sanitizers make all of it ten times slower.
  std::string small_cloud() const {
    std::ofstream file(at("small.pcd"));
    file << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1000\nHEIGHT 1\nDATA ascii\n";
    for (int i = 0; i < 1000; ++i)
      file << 10 + 0.1 * (i % 10) << ' ' << 0.1 * (i / 10 % 10) << ' ' << 0.1 * (i / 100) << '\n';
    return at("small.pcd");
  }

  /// The stamps of the frames in a file of JSON Lines.
  static std::vector<std::int64_t> stamps_in(const std::string& file) {
    std::vector<std::int64_t> stamps;
    std::istringstream lines(text_of(file));
    for (std::string line; std::getline(lines, line) && !lines.eof();)  // the last line may be incomplete
      stamps.push_back(nlohmann::json::parse(line)["stamp_ns"]);
    return stamps;
  }

  /// Of one topic to bv_stream and back from it.
  struct Talk {
    explicit Talk(const std::string& prefix)
        : carrier(middleware("dds").carrier("")), points(carrier->add_topic({prefix + "/points", kCloud})) {}
    void publish(const Bytes& cloud) const { carrier->send(points, 0, cloud); }
    bool heard() const {
      return wait_for([&] { return carrier->has_subscribers(points); });
    }
    std::unique_ptr<MessageSender> carrier;
    std::size_t points;
  };
};

TEST_F(Dds, EveryCloudOfOneProcessReachesTheOther) {
  // Queues are long enough for all clouds: none is dropped on a busy machine.
  BvStream to(at("to.err"), {"--source", "dds:/a/points", "--queue", "100", "--sink",
                             "jsonl:" + at("to.jsonl"), "--stats", at("to.json")});
  std::this_thread::sleep_for(std::chrono::seconds(1));
  BvStream from(at("from.err"),
                {"--source", small_cloud(), "--loop", "40", "--rate", "10", "--queue", "100", "--ground",
                 "none", "--sink", "dds:/a", "--sink", "jsonl:" + at("from.jsonl")});
  EXPECT_EQ(from.wait(), 0);
  const std::vector<std::int64_t> sent = stamps_in(at("from.jsonl"));
  ASSERT_EQ(sent.size(), 40U);
  EXPECT_TRUE(wait_for([&] {
    const auto received = stamps_in(at("to.jsonl"));
    return !received.empty() && received.back() == sent.back();
  }));
  EXPECT_EQ(to.end(SIGINT), 0);
  EXPECT_EQ(from.errors(), "");
  const std::vector<std::int64_t> received = stamps_in(at("to.jsonl"));
  ASSERT_GE(received.size(), 29U);  // the first ones may be sent before the processes discover each other
  EXPECT_TRUE(std::equal(received.end() - 29, received.end(), sent.end() - 29)) << text_of(at("to.jsonl"));
  const nlohmann::json stats = nlohmann::json::parse(text_of(at("to.json")));
  EXPECT_EQ(stats["frames"]["processed"], received.size());
  EXPECT_EQ(stats["frames"]["dropped"]["error"], 0);
}

// Volumes are those of the same clouds without a network.
TEST_F(Dds, AnswersACloudWithItsObjects) {
  BvStream node(at("err"),
                {"--source", "dds:/points", "--sink", "dds:/bv", "--volume", "aabb", "--ground", "none",
                 "--queue", "100"});  // clouds come until one is answered: none is dropped on a busy machine
  Talk talk("");
  const auto markers = middleware("dds").receiver("/bv/markers", {"visualization_msgs/msg/MarkerArray"});
  ASSERT_TRUE(talk.heard());
  ReceivedMessage message;
  ASSERT_TRUE(wait_for([&] {
    talk.publish(cube());
    return markers->next(message, std::chrono::milliseconds(100));
  })) << node.errors();
  msg::MarkerArray array;
  read_cdr(message.data, message.size, array);
  ASSERT_EQ(array.markers.size(), 1U);
  const msg::Marker& marker = array.markers.front();
  EXPECT_EQ(marker.header.frame_id, "lidar");
  EXPECT_EQ(marker.header.stamp.sec, 17);
  EXPECT_EQ(marker.header.stamp.nanosec, 5U);
  EXPECT_NEAR(marker.pose.position.x, 10.45, 1e-6);
  EXPECT_NEAR(marker.scale.x, 0.9, 1e-6);
  EXPECT_EQ(node.end(SIGINT), 0);
  EXPECT_EQ(node.errors(), "");
}

msg::TransformStamped step_from(const std::string& parent, const std::string& child, double x,
                                std::int32_t seconds) {
  msg::TransformStamped step;
  step.header = {{seconds, 5}, parent};
  step.child_frame_id = child;
  step.transform.translation.x = x;
  return step;
}

template <class Message>
Bytes cdr_of(const Message& message) {
  Bytes bytes;
  write_cdr(message, bytes);
  return bytes;
}

// Two sensors, whose places are known from /tf_static, on a robot, whose place is known from /tf.
TEST_F(Dds, TheCloudsOfTwoSensorsBecomeOneInTheFrameOfTheRobot) {
  const auto carrier = middleware("dds").carrier("");
  const std::size_t fixed = carrier->add_topic({"/tf_static", msg::TFMessage::ros_type, "cdr", true}),
                    moving = carrier->add_topic({"/tf", msg::TFMessage::ros_type}),
                    front = carrier->add_topic({"/front", kCloud}),
                    rear = carrier->add_topic({"/rear", kCloud});
  // Sent before anybody listens.
  carrier->send(fixed, 0,
                cdr_of(msg::TFMessage{{step_from("base", "front", 1, 0), step_from("base", "rear", -9, 0)}}));
  BvStream node(at("err"), {"--source", "dds:/front", "--source", "dds:/rear", "--target-frame", "base",
                            "--fixed-frame", "odom", "--ground", "none", "--volume", "aabb", "--queue", "100",
                            "--sink", "jsonl:" + at("lines")});
  ASSERT_TRUE(wait_for([&] { return carrier->has_subscribers(front) && carrier->has_subscribers(rear); }));
  std::int32_t seconds = 17;
  const auto merged = [&] {
    const std::string text = text_of(at("lines"));
    return text.find("\"points\":2000") != std::string::npos;
  };
  ASSERT_TRUE(wait_for([&] {
    ++seconds;
    carrier->send(moving, 0, cdr_of(msg::TFMessage{{step_from("odom", "base", 100, seconds)}}));
    carrier->send(front, 0, cube({{seconds, 5}, "front"}));
    carrier->send(rear, 0, cube({{seconds, 5}, "rear"}));
    return merged();
  })) << node.errors()
      << text_of(at("lines"));
  EXPECT_EQ(node.end(SIGINT), 0);
  std::istringstream lines(text_of(at("lines")));
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json frame = nlohmann::json::parse(line);
    if (frame.value("points", 0) != 2000) continue;
    EXPECT_EQ(frame["frame_id"], "base");
    EXPECT_EQ(frame["sensors"][1]["name"], "/rear");
    ASSERT_EQ(frame["clusters"].size(), 2U);
    std::vector<double> left;
    for (const auto& cluster : frame["clusters"])
      left.push_back(cluster["volumes"][0]["min"][0].get<double>());
    EXPECT_NEAR(std::max(left[0], left[1]), 11, 1e-5);
    EXPECT_NEAR(std::min(left[0], left[1]), 1, 1e-5);
    return;
  }
}

// The robot is at x = 100 + 10 t by its odometry, and 900 m further by /tf, which is ignored.
TEST_F(Dds, TheRobotsPosesComeFromItsTopicOfOdometry) {
  const auto carrier = middleware("dds").carrier("");
  const std::size_t tf = carrier->add_topic({"/tf", msg::TFMessage::ros_type}),
                    odometry = carrier->add_topic({"/odom", msg::Odometry::ros_type}),
                    points = carrier->add_topic({"/points", kCloud});
  BvStream node(at("err"), {"--source", "dds:/points", "--target-frame", "base", "--fixed-frame", "odom",
                            "--odometry", "/odom", "--sync", "500", "--ground", "none", "--volume", "aabb",
                            "--sink", "jsonl:" + at("lines"), "--sink", "mcap:" + at("out.mcap")});
  ASSERT_TRUE(wait_for([&] {
    return carrier->has_subscribers(points) && carrier->has_subscribers(odometry) &&
           carrier->has_subscribers(tf);
  })) << node.errors();
  std::int32_t seconds = 17;
  const auto send_pose = [&](std::uint32_t nanoseconds, double x) {
    msg::Odometry message;
    message.header = {{seconds, nanoseconds}, "odom"};
    message.child_frame_id = "base";
    message.pose.pose.position.x = x;
    message.pose.pose.orientation.w = 1;
    carrier->send(odometry, 0, cdr_of(message));
    carrier->send(tf, 0, cdr_of(msg::TFMessage{{step_from("odom", "base", x + 900, seconds)}}));
  };
  // A pose before and one after each cloud, so that it is interpolated. The next ones follow after its frame,
  // so that a busy machine misses none.
  for (int i = 0; i < 10; ++i) {
    ++seconds;
    send_pose(0, 10 * seconds);
    carrier->send(points, 0, cube({{seconds, 200'000'000}, "base"}));
    send_pose(400'000'000, 10 * seconds + 4);
    const auto sent = std::chrono::steady_clock::now();
    const std::string stamp = "\"stamp_ns\":" + std::to_string(seconds) + "200000000,";
    wait_for([&] {
      return text_of(at("lines")).find(stamp) != std::string::npos ||
             std::chrono::steady_clock::now() - sent > std::chrono::seconds(1);
    });
  }
  EXPECT_NE(text_of(at("lines")).find("\"points\":1000"), std::string::npos);
  EXPECT_EQ(node.end(SIGINT), 0) << node.errors();
  const std::int64_t stamp = seconds * 1'000'000'000LL + 200'000'000;
  Transforms written;
  const auto feed = recorded_transforms(at("out.mcap"), "");
  ASSERT_NE(feed, nullptr) << "no frame has a pose: " << node.errors();
  feed->read(stamp, written);
  const FoundTransform found = written.find("odom", "base", stamp);
  ASSERT_TRUE(found.pose) << found.problem;
  EXPECT_NEAR(found.pose->translation().x(), 1e-8 * static_cast<double>(stamp), 1e-6);
}

TEST_F(Dds, AStoppedReaderHoldsNothingUp) {
  BvStream reader(at("reader.err"), {"--source", "dds:/a/points", "--sink", "jsonl:" + at("reader.jsonl")});
  BvStream from(at("from.err"),
                {"--source", small_cloud(), "--loop", "40", "--rate", "10", "--ground", "none", "--sink",
                 "dds:/a", "--sink", "jsonl:" + at("from.jsonl"), "--stats", at("from.json")});
  ASSERT_TRUE(wait_for([&] { return lines_of(at("reader.jsonl")) > 0; }));
  reader.send(SIGSTOP);
  EXPECT_EQ(from.wait(), 0);
  reader.send(SIGCONT);
  EXPECT_EQ(from.errors(), "");
  const nlohmann::json stats = nlohmann::json::parse(text_of(at("from.json")));
  EXPECT_EQ(stats["frames"]["processed"], 40);
}

TEST_F(Dds, EitherSideMayDieAndComeBack) {
  const std::vector<std::string> reading{"--source", "dds:/a/points", "--sink", "jsonl:" + at("b.jsonl")};
  const std::vector<std::string> writing{"--source", small_cloud(), "--loop", "1000",   "--rate",
                                         "10",       "--ground",    "none",   "--sink", "dds:/a"};
  const auto comes_through = [&] {
    const std::size_t before = lines_of(at("b.jsonl"));
    return wait_for([&] { return lines_of(at("b.jsonl")) > before; });
  };
  BvStream reader(at("b.err"), reading), writer(at("a.err"), writing);
  ASSERT_TRUE(comes_through());
  EXPECT_EQ(writer.end(SIGKILL), 128 + SIGKILL);
  BvStream second_writer(at("a2.err"), writing);
  EXPECT_TRUE(comes_through());
  EXPECT_EQ(reader.end(SIGKILL), 128 + SIGKILL);
  std::filesystem::remove(at("b.jsonl"));
  BvStream second_reader(at("b2.err"), reading);
  EXPECT_TRUE(comes_through());
  EXPECT_EQ(second_reader.end(SIGINT), 0);
  EXPECT_EQ(second_writer.end(SIGINT), 0);
  EXPECT_EQ(second_writer.errors(), "");
}

TEST_F(Dds, WhatIsNoCloudIsACountedError) {
  BvStream node(at("err"), {"--source", "dds:/points", "--sink", "jsonl:" + at("out"), "--stats", at("stats"),
                            "--ground", "none"});
  Talk talk("");
  ASSERT_TRUE(talk.heard());
  const Bytes good = cube();
  // Whether the node listens yet is only known from what it does.
  ASSERT_TRUE(wait_for([&] {
    talk.publish(good);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return lines_of(at("out")) > 0;
  })) << node.errors();
  const auto fails = [&](const Bytes& bad, const std::string& why) {
    const std::size_t before = node.errors().size();
    EXPECT_TRUE(wait_for([&] {
      talk.publish(bad);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return node.errors().size() > before;
    })) << why;
    EXPECT_THAT(node.errors().substr(before), HasSubstr(why));
  };
  fails(Bytes(good.begin(), good.end() - 5000), "ends");
  fails(Bytes(good.begin(), good.begin() + 6), "ends");
  Bytes other_encoding = good;
  other_encoding[1] = std::byte{9};
  fails(other_encoding, "encapsulation");
  Bytes endless = good;
  std::memset(endless.data() + 12, 0xff, 4);  // the length of frame_id
  fails(endless, "ends");
  const std::size_t lines = lines_of(at("out"));
  const float nan = std::nanf("");
  for (const Bytes& fine : {cloud_of({}), cloud_of({nan, nan, nan}), good}) {
    const std::size_t before = lines_of(at("out"));
    EXPECT_TRUE(wait_for([&] {
      talk.publish(fine);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return lines_of(at("out")) > before;
    }));
  }
  EXPECT_GE(lines_of(at("out")), lines + 3);
  EXPECT_EQ(node.end(SIGINT), 0);
  const nlohmann::json stats = nlohmann::json::parse(text_of(at("stats")));
  EXPECT_GE(stats["frames"]["dropped"]["error"], 4);
}

// A socket's buffer can be no larger than the kernel allows: clouds of megabytes that come at once would be
// cut.
TEST_F(Dds, SaysWhatToTypeWhereTheKernelsBuffersAreSmall) {
  std::size_t most = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> most;
  BvStream node(at("err"), {"--source", "dds:/points", "--sink", "jsonl:" + at("out")});
  Talk talk("");
  ASSERT_TRUE(talk.heard());
  EXPECT_EQ(node.end(SIGINT), 0);
  const std::string command = "sudo sysctl -w net.core.rmem_max=8388608\n";
  EXPECT_EQ(text_of(at("err")).find(command) != std::string::npos, most < 8388608) << most;
}

// Clouds of a Livox, and compressed ones of 400 points.
TEST_F(Dds, ReadsTheTypeOfCloudsThatIsPublished) {
  const Bytes raw(std::size_t{16} * 400, std::byte{0x3f});
  Bytes packed(ZSTD_compressBound(raw.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), 1));
  const std::pair<const char*, Bytes> clouds[]{
      {"livox_ros_driver2/msg/CustomMsg", livox_message(Encoding::cdr, 400)},
      {"livox_ros_driver/msg/CustomMsg", livox_message(Encoding::cdr, 400)},
      {"point_cloud_interfaces/msg/CompressedPointCloud2",
       compressed_message(Encoding::cdr, CompressedCloud{1, 400, 16, 6400, "zstd"}, packed)}};
  for (const auto& [type, bytes] : clouds) {
    std::filesystem::remove(at("out"));
    BvStream node(at("err"), {"--source", "dds:/points", "--sink", "jsonl:" + at("out"), "--ground", "none"});
    const auto carrier = middleware("dds").carrier("");
    const std::size_t topic = carrier->add_topic({"/points", type});
    EXPECT_TRUE(wait_for([&] {
      carrier->send(topic, 0, bytes);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      return lines_of(at("out")) > 0;
    })) << type
        << node.errors();
    EXPECT_THAT(text_of(at("out")), HasSubstr("\"points\":400,")) << type;
    EXPECT_EQ(node.end(SIGINT), 0);
    EXPECT_THAT(node.errors(), testing::Not(HasSubstr("publisher ignored"))) << type;
  }
}

TEST_F(Dds, SaysThatATopicHasAnotherType) {
  BvStream node(at("err"), {"--source", "dds:/points", "--sink", "jsonl:" + at("out")});
  const auto carrier = middleware("dds").carrier("");
  carrier->add_topic({"/points", "sensor_msgs/msg/Image"});
  EXPECT_TRUE(wait_for([&] { return !node.errors().empty(); }));
  EXPECT_THAT(node.errors(), HasSubstr("dds:/points: published as sensor_msgs/msg/Image: publisher ignored, "
                                       "expected sensor_msgs/msg/PointCloud2"));
  EXPECT_EQ(node.end(SIGTERM), 0);
}

int status_of(const std::string& errors, const std::vector<std::string>& arguments) {
  BvStream node(errors, arguments);
  return node.wait();
}

TEST_F(Dds, RefusesWhatIsNoTopicAndNoDomain) {
  for (const std::string topic : {"/a//b", "/9a", "", "/", "/a/", "/a b", "a-b"}) {
    EXPECT_EQ(status_of(at("err"), {"--source", "dds:" + topic}), 2) << topic;
    EXPECT_THAT(text_of(at("err")), HasSubstr("is not a valid topic name")) << topic;
    EXPECT_EQ(lines_of(at("err")), 1U);
  }
  EXPECT_EQ(status_of(at("err"), {"--source", "synth:street-sequence:1", "--sink", "dds:a-b"}), 2);
  EXPECT_THAT(text_of(at("err")), HasSubstr("is not a valid topic name"));
  EXPECT_EQ(status_of(at("err"), {"--source", "dds:/points", "--rate", "10"}), 2);
  EXPECT_THAT(text_of(at("err")), HasSubstr("--rate: not with a live source"));
  const std::string own = std::to_string(own_domain());
  setenv("ROS_DOMAIN_ID", "233", 1);
  EXPECT_EQ(status_of(at("err"), {"--source", "dds:/points"}), 2);
  EXPECT_THAT(text_of(at("err")), HasSubstr("ROS_DOMAIN_ID: '233' is not a whole number from 0 to 232"));
  setenv("ROS_DOMAIN_ID", own.c_str(), 1);
}

TEST_F(Dds, WithoutANetworkIsOneLine) {
  setenv("CYCLONEDDS_URI", "<General><Interfaces><NetworkInterface name=\"none0\"/></Interfaces></General>",
         1);
  EXPECT_EQ(status_of(at("err"), {"--source", "dds:/points"}), 1);
  unsetenv("CYCLONEDDS_URI");
  EXPECT_EQ(lines_of(at("err")), 1U) << text_of(at("err"));
  EXPECT_THAT(text_of(at("err")), HasSubstr("none0"));
}

}  // namespace
}  // namespace pcl_bv::test
