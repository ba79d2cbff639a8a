// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ROS 1 node, which receives clouds and publishes objects.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <sensor_msgs/PointCloud2.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/stream_runner.h"
#include "pcl_bv/nodes/topics.h"
#include "rig_reader.h"
#include "ros1_sender.h"
#include "stream/sources/message_stamps.h"
#include "stream/topics/message_adapter.h"

namespace pcl_bv {
using namespace detail;

/// Subscribes to clouds on `points` while any topic but `/diagnostics` has subscribers. If the parameters
/// have a rig, merges the clouds of its topics instead (RigReader). Publishes:
///
/// - `markers`: the objects of each cloud (visualization_msgs/MarkerArray);
/// - `labels`: the points of each cloud with the ids of their objects;
/// - `/diagnostics`: the node's state, once a second;
/// - the messages of the adapters that the parameter `publish` names.
///
/// Counts the clouds that cannot be read, and logs a warning about them at most every ten seconds.
class ClusterVolumes {
 public:
  /// Throws ConfigError for invalid parameters (config_of()), and IoError if a file of regions or the URDF of
  /// the rig cannot be read.
  ClusterVolumes(const ros::NodeHandle& topics, const ros::NodeHandle& parameters);
  ~ClusterVolumes();
  ClusterVolumes(const ClusterVolumes&) = delete;
  ClusterVolumes& operator=(const ClusterVolumes&) = delete;

 private:
  void update_subscription();
  void open_rig(const StreamConfig& config);
  void receive(const sensor_msgs::PointCloud2ConstPtr& cloud);
  void publish(const Frame& frame, const FrameResult& result);
  void publish_adapters(Frame frame, const FrameResult& result);
  StreamRunner::Callbacks callbacks();

  std::string name_, class_field_;
  ros::NodeHandle topics_;
  FramePipeline pipeline_;
  std::mutex subscription_mutex_;
  std::atomic<bool> subscribed_{false};
  bool ended_ = false;  // under subscription_mutex_
  ros::Publisher markers_, labels_, diagnostics_;
  ros::Subscriber points_;
  Ros1Sender sender_;
  std::vector<std::unique_ptr<MessageAdapter>> adapters_;
  MessageStamps stamps_;
  ShownObjects shown_;
  MarkerLifetime lifetime_;
  StreamHealth health_;
  std::unique_ptr<StreamRunner> runner_;
  std::unique_ptr<RigReader> rig_;  // null for the clouds of one sensor in their own frame
};

}  // namespace pcl_bv
