// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The component of docs/ros.md with ROS 1's messages.

#include "../../examples/ros2_component.cpp"

#include "ros1_test.h"

namespace {

using pcl_bv::test::text_of;

PointCloud2::UniquePtr cube() {
  auto cloud = std::make_unique<PointCloud2>();
  static_cast<sensor_msgs::PointCloud2&>(*cloud) = pcl_bv::test::cube();
  return cloud;
}

template <class Endpoint>
Endpoint& topic(ClusterVolumes& node, const std::string& name) {
  return *std::static_pointer_cast<Endpoint>(node.topics.at(name));
}

TEST(Ros2Component, AnswersACloudWithItsMarkers) {
  const pcl_bv::test::TemporaryFolder folder;
  const std::string file = (folder / "component.yaml").string();
  std::ofstream(file) << "ground: {method: none}\nvolumes: [aabb]\n";
  ClusterVolumes node(rclcpp::NodeOptions{{{"config", file}}});
  auto& points = topic<rclcpp::Subscription<PointCloud2>>(node, "points");
  auto& markers = topic<rclcpp::Publisher<MarkerArray>>(node, "markers");
  points.receive(cube());
  ASSERT_EQ(markers.published.size(), 1U);
  ASSERT_EQ(markers.published.front()->markers.size(), 1U);
  const auto& marker = markers.published.front()->markers.front();
  EXPECT_EQ(marker.header.frame_id, "lidar");
  EXPECT_EQ(marker.header.stamp, ros::Time(17, 5));
  EXPECT_NEAR(marker.scale.x, 0.9, 1e-6);
  EXPECT_NEAR(marker.pose.position.x, 10.45, 1e-6);
  auto cut_off = cube();
  cut_off->data.resize(5);
  points.receive(std::move(cut_off));
  EXPECT_EQ(node.warnings.size(), 1U);
  EXPECT_EQ(markers.published.size(), 1U);
}

TEST(Ros2Component, OfTheDocumentationIsThisOne) {
  const std::string example = text_of(PCL_BV_SOURCES "/examples/ros2_component.cpp");
  const std::size_t begin = example.find("#include");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_NE(text_of(PCL_BV_SOURCES "/docs/ros.md").find(example.substr(begin)), std::string::npos);
}

}  // namespace
