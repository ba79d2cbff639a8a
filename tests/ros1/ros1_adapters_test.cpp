// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The topics that the parameter `publish` adds. Subscribers announce the sums that the packages of ROS 1
// have, so roscpp connects them only if ours are equal.

#include <gmock/gmock.h>

#include <cmath>

#include "pcl_bv/messages/moveit.h"
#include "pcl_bv/messages/polygon.h"
#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/messages/vision.h"
#include "ros1_test.h"

namespace pcl_bv::test {
namespace {

/// A message of ours as a type of roscpp.
template <class Message>
struct Ros1Message : Message {
  using ConstPtr = boost::shared_ptr<const Ros1Message>;
};

// The sums published for Noetic, by type.
template <class Message>
const char* published_sum() {
  const std::string type = Message::ros_type;
  if (type == msg::CollisionObject::ros_type) return "dbba710596087da521c07564160dfccb";
  if (type == msg::PlanningScene::ros_type) return "acfc50bcfd6c7b978066bfa7c786002c";
  if (type == msg::PolygonStamped::ros_type) return "c6be8f7dc3bee7fe9e8d296070f53340";
  if (type == msg::BoundingBox3DArray::ros_type) return "9e1a3932308592aa1b20232d818486db";
  if (type == msg::Ros1Detection3DArray::ros_type) return "05c51d9aea1fb4cfdc8effb94f197b6f";
  return "unknown";
}

}  // namespace
}  // namespace pcl_bv::test

namespace ros {
namespace message_traits {
template <class Message>
struct IsMessage<pcl_bv::test::Ros1Message<Message>> : TrueType {};
template <class Message>
struct MD5Sum<pcl_bv::test::Ros1Message<Message>> {
  static const char* value() { return pcl_bv::test::published_sum<Message>(); }
};
template <class Message>
struct DataType<pcl_bv::test::Ros1Message<Message>> {
  static const char* value() {
    static const std::string name = pcl_bv::ros1_type_of(Message::ros_type).name;
    return name.c_str();
  }
};
}  // namespace message_traits
namespace serialization {
template <class Message>
struct Serializer<pcl_bv::test::Ros1Message<Message>> {
  template <class Stream>
  static void read(Stream& stream, pcl_bv::test::Ros1Message<Message>& message) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(stream.getData());
    pcl_bv::read_ros1(bytes, stream.getLength(), static_cast<Message&>(message));
    stream.advance(stream.getLength());
  }
};
}  // namespace serialization
}  // namespace ros

namespace pcl_bv::test {
namespace {

class Ros1Adapters : public Ros1Test {
 protected:
  /// The first messages of these topics about a cube, from a node that publishes the adapter's messages.
  template <class Message>
  typename Ros1Message<Message>::ConstPtr first_of(const std::string& adapter, const std::string& topic) {
    const auto running = node({"_ground/method:=none", "_volumes:=aabb", "_publish:=" + adapter});
    Heard<Ros1Message<Message>> heard(ros(), topic);
    const Lidar lidar(ros());
    EXPECT_TRUE(lidar.heard()) << running->errors();
    lidar.send(cube());
    EXPECT_TRUE(wait_for([&] { return heard.size() > 0; }));
    const auto all = heard.all();
    EXPECT_EQ(running->end(SIGINT), 0);
    return all.empty() ? nullptr : all.front();
  }

  static void expect_cube(const msg::CollisionObject& object) {
    EXPECT_EQ(object.header.frame_id, "lidar");
    EXPECT_EQ(msg::nanoseconds_of(object.header.stamp), 17'000'000'005);
    EXPECT_EQ(object.id, "bv_cluster_0");
    EXPECT_EQ(object.operation, msg::CollisionObject::ADD);
    ASSERT_EQ(object.primitives.size(), 1U);
    EXPECT_EQ(object.primitives[0].type, msg::ShapePrimitive::BOX);
    ASSERT_EQ(object.primitives[0].dimensions.size(), 3U);
    for (const double side : object.primitives[0].dimensions)
      EXPECT_NEAR(side, 0.9, 1e-6);
    EXPECT_NEAR(object.pose.position.x, 10.45, 1e-6);
  }
};

TEST_F(Ros1Adapters, PublishPlanningScenesOfMoveIt) {
  const auto scene = first_of<msg::PlanningScene>("moveit", "planning_scene");
  ASSERT_TRUE(scene);
  EXPECT_TRUE(scene->is_diff && scene->robot_state.is_diff);
  ASSERT_EQ(scene->collision_objects.size(), 1U);
  expect_cube(scene->collision_objects[0]);
}

TEST_F(Ros1Adapters, PublishCollisionObjectsOfMoveIt) {
  const auto object = first_of<msg::CollisionObject>("moveit", "collision_object");
  ASSERT_TRUE(object);
  expect_cube(*object);
}

TEST_F(Ros1Adapters, PublishFootprintsForCostmaps) {
  const auto footprint = first_of<msg::PolygonStamped>("nav2", "footprints");
  ASSERT_TRUE(footprint);
  EXPECT_EQ(footprint->header.frame_id, "lidar");
  ASSERT_EQ(footprint->polygon.points.size(), 4U);
  for (const msg::Point32& corner : footprint->polygon.points)
    EXPECT_NEAR(std::abs(corner.x - 10.45F), 0.45, 1e-5);
}

TEST_F(Ros1Adapters, PublishBoxesOfVisionMsgs) {
  const auto boxes = first_of<msg::BoundingBox3DArray>("vision,moveit", "boxes");
  ASSERT_TRUE(boxes);
  ASSERT_EQ(boxes->boxes.size(), 1U);
  EXPECT_NEAR(boxes->boxes[0].size.x, 0.9, 1e-6);
}

TEST_F(Ros1Adapters, PublishDetectionsWithTheirPoints) {
  const auto array = first_of<msg::Ros1Detection3DArray>("vision", "objects");
  ASSERT_TRUE(array);
  ASSERT_EQ(array->detections.size(), 1U);
  const msg::Ros1Detection3D& detection = array->detections[0];
  EXPECT_NEAR(detection.bbox.center.position.x, 10.45, 1e-6);
  EXPECT_EQ(detection.source_cloud.width, 1000U);
  EXPECT_EQ(detection.source_cloud.data.size, 16'000U);
  EXPECT_EQ(detection.source_cloud.header.frame_id, "lidar");
  ASSERT_EQ(detection.results.size(), 1U);
  EXPECT_EQ(detection.results[0].id, -1);  // points have no classes
}

TEST_F(Ros1Adapters, AreOnlyThoseOfTheParameter) {
  const auto running = node({"_ground/method:=none", "_volumes:=aabb"});
  Heard<sensor_msgs::PointCloud2> labels(ros(), "labels");
  ASSERT_TRUE(wait_for([&] { return labels.connected(); }));
  Heard<Ros1Message<msg::PlanningScene>> scenes(ros(), "planning_scene");
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_FALSE(scenes.connected());
}

TEST_F(Ros1Adapters, ThatAreUnknownAreRefused) {
  const auto running = node({"_publish:=movit"});
  EXPECT_EQ(running->wait(), 2);
  EXPECT_THAT(running->errors(),
              testing::HasSubstr("cluster_volumes: /cluster_volumes: publish: 'movit' is not moveit"));
}

}  // namespace
}  // namespace pcl_bv::test
