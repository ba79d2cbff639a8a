// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A ROS 2 component that receives clouds and publishes markers of the objects in each cloud.

#include <pcl_bv/nodes/frame_pipeline.h>
#include <pcl_bv/nodes/stream_runner.h>
#include <pcl_bv/nodes/topics.h>

#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <sensor_msgs/msg/point_cloud2.hpp>
#include <visualization_msgs/msg/marker_array.hpp>

using sensor_msgs::msg::PointCloud2;
using visualization_msgs::msg::MarkerArray;

class ClusterVolumes : public rclcpp::Node {
 public:
  explicit ClusterVolumes(const rclcpp::NodeOptions& options) : Node("cluster_volumes", options) {
    const std::string file = declare_parameter("config", std::string());
    if (!file.empty()) pipeline_.set_config(pcl_bv::read_stream_config(file).pipeline);
    markers_ = create_publisher<MarkerArray>("markers", 5);
    points_ = create_subscription<PointCloud2>("points", rclcpp::SensorDataQoS().keep_last(1),
                                               [this](PointCloud2::UniquePtr cloud) { receive(std::move(cloud)); });
  }

 private:
  void receive(PointCloud2::UniquePtr cloud) {
    try {
      pcl_bv::Frame frame;
      pcl_bv::read_cloud(std::move(cloud), "", frame);
      pipeline_.process(frame, result_);
      auto markers = std::make_unique<MarkerArray>();
      const auto shapes = pcl_bv::viewer_shapes(result_);
      pcl_bv::fill_markers(frame, result_, shapes, lifetime_.next(frame.header.stamp_ns), shown_, *markers);
      markers_->publish(std::move(markers));
    } catch (const std::exception& error) {
      RCLCPP_WARN(get_logger(), "cloud lost: %s", error.what());
    }
  }

  pcl_bv::FramePipeline pipeline_;
  pcl_bv::FrameResult result_;
  pcl_bv::ShownObjects shown_;
  pcl_bv::MarkerLifetime lifetime_;
  rclcpp::Publisher<MarkerArray>::SharedPtr markers_;
  rclcpp::Subscription<PointCloud2>::SharedPtr points_;
};

RCLCPP_COMPONENTS_REGISTER_NODE(ClusterVolumes)
