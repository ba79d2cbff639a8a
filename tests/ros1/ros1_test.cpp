// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The node and the nodelet between a publisher of clouds and those who listen to its objects.

#include "ros1_test.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gmock/gmock.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <cstring>
#include <set>

namespace pcl_bv::test {
namespace {

using diagnostic_msgs::DiagnosticArray;
using sensor_msgs::PointCloud2;
using testing::HasSubstr;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

class Ros1 : public Ros1Test {
 protected:
  // The cube's box, whoever fitted it.
  void expect_box(const Marker& marker) {
    EXPECT_EQ(marker.header.frame_id, "lidar");
    EXPECT_EQ(marker.header.stamp, ::ros::Time(17, 5));
    EXPECT_EQ(marker.ns, "aabb");
    EXPECT_EQ(marker.type, Marker::CUBE);
    EXPECT_EQ(marker.action, Marker::ADD);
    EXPECT_NEAR(marker.pose.position.x, 10.45, 1e-6);
    EXPECT_NEAR(marker.pose.position.y, 0.45, 1e-6);
    EXPECT_NEAR(marker.scale.x, 0.9, 1e-6);
  }

  void expect_an_answer() {
    Heard<MarkerArray> markers(ros(), "markers");
    const Lidar lidar(ros());
    ASSERT_TRUE(lidar.heard());
    lidar.send(cube());
    ASSERT_TRUE(wait_for([&] { return markers.size() > 0; }));
    ASSERT_EQ(markers.all().front()->markers.size(), 1U);
    expect_box(markers.all().front()->markers.front());
  }
};

const std::vector<std::string> kPlain{"_ground/method:=none", "_volumes:=aabb"};

TEST_F(Ros1, AnswersACloudWithItsMarkersLabelsAndDiagnostics) {
  const auto running = node(kPlain);
  Heard<MarkerArray> markers(ros(), "markers");
  Heard<PointCloud2> labels(ros(), "labels");
  Heard<DiagnosticArray> diagnostics(ros(), "/diagnostics");
  const Lidar lidar(ros());
  ASSERT_TRUE(lidar.heard());
  ASSERT_TRUE(wait_for([&] { return markers.connected() && labels.connected() && diagnostics.connected(); }));
  lidar.send(cube());
  ASSERT_TRUE(wait_for([&] { return markers.size() > 0 && labels.size() > 0 && diagnostics.size() > 0; }));
  ASSERT_EQ(markers.all().front()->markers.size(), 1U);
  expect_box(markers.all().front()->markers.front());

  const PointCloud2& labelled = *labels.all().front();
  const PointCloud2 sent = cube();
  EXPECT_EQ(labelled.header.stamp, sent.header.stamp);
  EXPECT_EQ(labelled.header.frame_id, "lidar");
  ASSERT_EQ(labelled.width, 1000U);
  ASSERT_EQ(labelled.data.size(), 16'000U);
  for (std::size_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(std::memcmp(&labelled.data[16 * i], &sent.data[12 * i], 12), 0) << i;
    const unsigned char first_object[4] = {};
    EXPECT_EQ(std::memcmp(&labelled.data[16 * i + 12], first_object, 4), 0) << i;
  }
  const auto& status = diagnostics.all().front()->status;
  ASSERT_EQ(status.size(), 1U);
  EXPECT_EQ(status.front().name, "/cluster_volumes: objects in clouds");
  EXPECT_EQ(status.front().level, diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_EQ(running->end(SIGINT), 0);
}

TEST_F(Ros1, ListensOnlyWhileSomebodyListens) {
  const auto running = node(kPlain);
  const Lidar lidar(ros());
  {
    const Heard<DiagnosticArray> diagnostics(ros(), "/diagnostics");
    ASSERT_TRUE(wait_for([&] { return diagnostics.connected(); }));  // the node is there
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(lidar.listeners(), 0U);
  for (int again = 0; again < 2; ++again) {
    Heard<MarkerArray> markers(ros(), "markers");
    EXPECT_TRUE(lidar.heard());
    Heard<PointCloud2> labels(ros(), "labels");
    ASSERT_TRUE(wait_for([&] { return labels.connected(); }));
    markers.stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_EQ(lidar.listeners(), 1U);
    labels.stop();
    EXPECT_TRUE(wait_for([&] { return lidar.listeners() == 0; }));
  }
  EXPECT_EQ(running->end(SIGINT), 0);
}

TEST_F(Ros1, TakesParametersAsTheFileHasThem) {
  XmlRpc::XmlRpcValue volumes;
  volumes[0] = "aabb";
  volumes[1] = "sphere-exact";
  ros().setParam("/cluster_volumes/volumes", volumes);
  ros().setParam("/cluster_volumes/filter/range_max", 30);
  ros().setParam("/cluster_volumes/preset", "indoor");
  std::ofstream(at("own.yaml")) << "ground: {method: none}\ncluster: {tolerance: 0.3}\n";
  ros().setParam("/cluster_volumes/config", at("own.yaml"));
  const auto running = node();
  Heard<MarkerArray> markers(ros(), "markers");
  const Lidar lidar(ros());
  ASSERT_TRUE(lidar.heard()) << running->errors();
  lidar.send(cube());
  ASSERT_TRUE(wait_for([&] { return markers.size() > 0; }));
  std::multiset<std::string> names;
  for (const Marker& marker : markers.all().front()->markers)
    names.insert(marker.ns);
  EXPECT_EQ(names, (std::multiset<std::string>{"aabb", "sphere-exact"}));
}

TEST_F(Ros1, RefusesParametersThatAreNotAllowed) {
  const auto refuses = [&](const std::string& argument, const std::string& why, int status = 2) {
    const auto running = node({argument});
    EXPECT_EQ(running->wait(), status) << argument;
    EXPECT_EQ(lines_of(at("node.err")), 1U) << running->errors();
    EXPECT_THAT(running->errors(), HasSubstr(why)) << argument;
    ros().deleteParam("/cluster_volumes");
  };
  refuses("_cluster/tolerance:=-1",
          "cluster_volumes: /cluster_volumes: cluster.tolerance: -1 is not at least 0");
  refuses("_cluster/tolerance:=far", "cluster.tolerance: 'far' is not a number");
  refuses("_cluster/tolerence:=1", "unknown key 'cluster.tolerence'");
  refuses("_volumes:=ball", "'ball'");
  refuses("_preset:=moon",
          "preset: 'moon' is not one of road, indoor, table; parameters stay on the parameter server until "
          "'rosparam delete /cluster_volumes/preset'");
  ros().setParam("/cluster_volumes/preset", "moon");  // of an earlier run
  refuses("_volumes:=aabb", "'rosparam delete /cluster_volumes/preset'");
  ros().setParam("/cluster_volumes/preset", std::vector<int>{1});
  refuses("_volumes:=aabb", "preset: is not a text");
  refuses("_config:=" + at("nothing.yaml"), at("nothing.yaml"));
  std::ofstream(at("bad.yaml")) << "filter:\n  range_min: -2\n";
  refuses("_config:=" + at("bad.yaml"), "bad.yaml: line 2: filter.range_min: -2 is not at least 0");
}

// The manager lives on after a nodelet that could not be loaded.
TEST_F(Ros1, ANodeletInAManagerDoesTheSame) {
  const auto manager = command("manager", {"/usr/lib/nodelet/nodelet", "manager", "__name:=manager"});
  const auto load = [&](const std::string& name) {
    return command(name, {"/usr/lib/nodelet/nodelet", "load", "pcl_bv/ClusterVolumes", "manager",
                          "__name:=" + name, "_ground/method:=none", "_volumes:=aabb"});
  };
  ros().setParam("/bad/threads", -4);
  EXPECT_NE(load("bad")->wait(), 0);
  EXPECT_THAT(manager->errors(), HasSubstr("/bad: threads: '-4' is not a whole number"));
  EXPECT_FALSE(manager->ended());
  const auto good = load("good");
  expect_an_answer();
  EXPECT_EQ(good->end(SIGINT), 0);  // unloads it
  Heard<MarkerArray> markers(ros(), "markers");
  EXPECT_TRUE(wait_for([&] { return !markers.connected(); }));
  EXPECT_FALSE(manager->ended());
}

// The labels have the stamps that the node uses.
TEST_F(Ros1, AStampOfZeroIsAStampAndWithoutStampsALineSaysSo) {
  const auto running = node({"_ground/method:=none"});
  Heard<sensor_msgs::PointCloud2> labels(ros(), "labels");
  const Lidar lidar(ros());
  ASSERT_TRUE(lidar.heard()) << running->errors();
  for (std::size_t i = 1; i <= 2; ++i) {
    sensor_msgs::PointCloud2 cloud = cube();
    cloud.header.stamp = ::ros::Time();
    lidar.send(cloud);
    ASSERT_TRUE(wait_for([&] { return labels.size() == i; }));
    EXPECT_EQ(labels.all().back()->header.stamp.isZero(), i == 1);
  }
  EXPECT_TRUE(wait_for([&] { return running->errors().find("have no stamps") != std::string::npos; }));
}

TEST_F(Ros1, CountsHostileCloudsAndLives) {
  const auto running = node(kPlain);
  Heard<MarkerArray> markers(ros(), "markers");
  Heard<DiagnosticArray> diagnostics(ros(), "/diagnostics");
  const Lidar lidar(ros());
  ASSERT_TRUE(lidar.heard());
  ASSERT_TRUE(wait_for([&] { return markers.connected() && diagnostics.connected(); }));
  std::vector<PointCloud2> hostile(7, cube());
  hostile[0].data.resize(5000);
  hostile[1].fields.pop_back();
  hostile[2].width = 0xffffffff;
  hostile[3].point_step = 0;
  hostile[4].fields[2].offset = 0xfffffff0;
  hostile[5].fields[1].datatype = 99;
  hostile[6].height = hostile[6].width = hostile[6].row_step = 0x80000000;
  const float nan = std::nanf("");
  const auto bad = static_cast<int>(hostile.size());
  hostile.emplace_back();               // good: filters publish clouds without fields when no point is left
  hostile.push_back(cloud_of({}, 18));  // good, and without objects
  hostile.push_back(cloud_of({nan, nan, nan}, 18));
  for (const PointCloud2& cloud : hostile) {
    lidar.send(cloud);
    std::this_thread::sleep_for(
        std::chrono::milliseconds(50));  // of those that wait the oldest would be dropped
  }
  ASSERT_TRUE(wait_for([&] {
    lidar.send(cube(40));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const auto all = markers.all();
    return !all.empty() && all.back()->markers.size() == 1;
  })) << running->errors();
  EXPECT_THAT(running->errors(), HasSubstr("/cluster_volumes: cloud lost: "));
  const auto lost = [&] {
    const auto all = diagnostics.all();
    if (all.empty()) return -1;
    const auto& status = all.back()->status.front();
    EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
    EXPECT_EQ(status.values[1].key, "lost");
    return std::stoi(status.values[1].value);
  };
  EXPECT_TRUE(wait_for([&] { return lost() == bad; })) << lost();
  EXPECT_EQ(running->end(SIGINT), 0);
}

TEST_F(Ros1, ReadsCloudsOfTheOtherByteOrder) {
  const auto running = node(kPlain);
  Heard<MarkerArray> markers(ros(), "markers");
  const Lidar lidar(ros());
  ASSERT_TRUE(lidar.heard());
  PointCloud2 cloud = cube();
  cloud.is_bigendian = 1;
  for (std::size_t i = 0; i < cloud.data.size(); i += 4)
    std::reverse(&cloud.data[i], &cloud.data[i] + 4);
  lidar.send(cloud);
  ASSERT_TRUE(wait_for([&] { return markers.size() > 0; }));
  ASSERT_EQ(markers.all().front()->markers.size(), 1U);
  expect_box(markers.all().front()->markers.front());
}

}  // namespace
}  // namespace pcl_bv::test
