// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <stdexcept>

#include "pcl_bv/messages/schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pcl_bv/messages/moveit.h"
#include "pcl_bv/messages/obstacles.h"
#include "pcl_bv/messages/polygon.h"
#include "pcl_bv/messages/vision.h"

namespace pcl_bv::detail {
namespace {

TEST(Schemas, HoldEachTypeThatTheyNameOnce) {
  const std::string line(80, '=');
  EXPECT_EQ(schema_of(msg::Header::ros_type),
            "builtin_interfaces/Time stamp\nstring frame_id\n" + line +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
  const std::string markers = schema_of(msg::MarkerArray::ros_type);
  for (const char* name : {"visualization_msgs/Marker", "std_msgs/Header", "geometry_msgs/Point"}) {
    const std::string head = "MSG: " + std::string(name) + "\n";
    ASSERT_NE(markers.find(head), std::string::npos) << name;
    EXPECT_EQ(markers.find(head), markers.rfind(head)) << name;
  }
}

TEST(Schemas, AreThereForEveryMessage) {
  for (const char* type :
       {msg::PointCloud2::ros_type, msg::Detection3DArray::ros_type, msg::MarkerArray::ros_type,
        msg::SceneUpdate::ros_type, msg::DiagnosticArray::ros_type, msg::TFMessage::ros_type,
        msg::PolygonStamped::ros_type, msg::CollisionObject::ros_type, msg::PlanningScene::ros_type,
        msg::ObstacleArray::ros_type, msg::PolygonInstanceStamped::ros_type,
        msg::BoundingBox3DArray::ros_type, msg::LabelInfo::ros_type})
    EXPECT_GT(schema_of(type).size(), 100U) << type;
}

TEST(Schemas, OfUnknownTypesAreRefused) {
  EXPECT_THROW(schema_of("std_msgs/msg/String"), std::invalid_argument);
  EXPECT_THROW(ros1_type_of("std_msgs/msg/String"), std::invalid_argument);
  EXPECT_THROW(ros1_type_of("foxglove_msgs/msg/SceneUpdate"), std::invalid_argument);
}

TEST(Schemas, OfRos1HaveItsTimesAndNoDefaultValues) {
  const Ros1Type type = ros1_type_of(msg::CollisionObject::ros_type);
  EXPECT_EQ(type.name, "moveit_msgs/CollisionObject");
  EXPECT_THAT(type.definition,
              testing::HasSubstr("\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"));
  EXPECT_THAT(type.definition, testing::HasSubstr("\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\n"));
  for (const char* of_ros2 : {"builtin_interfaces", "/msg/", "PRISM", "<="})
    EXPECT_EQ(type.definition.find(of_ros2), std::string::npos) << of_ros2;
}

}  // namespace
}  // namespace pcl_bv::detail
