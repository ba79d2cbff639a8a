// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cluster_volumes.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/console.h>
#include <visualization_msgs/MarkerArray.h>

#include <exception>
#include <optional>
#include <stdexcept>
#include <utility>

#include "parameters.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv {
using namespace detail;

ClusterVolumes::ClusterVolumes(const ros::NodeHandle& topics, const ros::NodeHandle& parameters)
    : name_(parameters.getNamespace()), topics_(topics), sender_(topics, [this] { update_subscription(); }) {
  NodeConfig config = config_of(parameters);
  // Parameters of earlier runs stay on the parameter server. So the log tells which ones are used.
  if (!config.parameters.empty()) ROS_INFO_STREAM(name_ << ": parameters: " << config.parameters);
  std::vector<std::string> warnings = config.pipeline.ineffective_settings();
  if (std::optional<RegionConfig> body = robot_body(config.rig, warnings))
    config.pipeline.filter.regions.push_back(*std::move(body));
  for (const std::string& line : warnings)
    ROS_WARN_STREAM(message_line(name_ + ": " + line));
  if (const auto& field = config.pipeline.cluster.class_field) class_field_ = field->name;
  pipeline_ = FramePipeline(config.pipeline);
  runner_ = std::make_unique<StreamRunner>(callbacks(), config.runner);
  if (!config.rig.frame.empty()) open_rig(config);
  const std::lock_guard lock(subscription_mutex_);
  const auto changed = [this](const ros::SingleSubscriberPublisher&) { update_subscription(); };
  markers_ = topics_.advertise<visualization_msgs::MarkerArray>("markers", 5, changed, changed);
  labels_ = topics_.advertise<sensor_msgs::PointCloud2>("labels", 2, changed, changed);
  diagnostics_ = topics_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 5);
  for (const std::string& name : config.publish)
    adapters_.push_back(adapter_kind(name).make(sender_, ""));
}

ClusterVolumes::~ClusterVolumes() {
  {
    const std::lock_guard lock(subscription_mutex_);
    ended_ = true;
  }
  markers_.shutdown();
  labels_.shutdown();
  points_.shutdown();
  rig_.reset();
  runner_.reset();
  for (const auto& adapter : adapters_)
    adapter->close();
  sender_.close();
}

void ClusterVolumes::open_rig(const StreamConfig& config) {
  const auto warn = [this](const std::string& line) { ROS_WARN_STREAM(message_line(name_ + ": " + line)); };
  try {
    rig_ = std::make_unique<RigReader>(topics_, config, *runner_, warn);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(name_ + ": rig: " + error.what());
  }
}

StreamRunner::Callbacks ClusterVolumes::callbacks() {
  StreamRunner::Callbacks calls;
  calls.process = [this](const Frame& frame, FrameResult& result) { pipeline_.process(frame, result); };
  calls.on_result = [this](const Frame& frame, const FrameResult& result) { publish(frame, result); };
  calls.on_lost = [this](const Frame& frame, Loss loss, const std::string& reason) {
    health_.count_lost();
    const std::string sensor = frame.file.empty() ? "" : frame.file + ": ";
    if (loss == Loss::error)
      ROS_WARN_STREAM_THROTTLE(10, message_line(name_ + ": cloud lost: " + sensor + reason));
  };
  calls.on_silence = [this](double seconds) {
    if (subscribed_) ROS_WARN_STREAM(name_ << ": no cloud for " << seconds << " s");
  };
  return calls;
}

void ClusterVolumes::update_subscription() {
  const std::lock_guard lock(subscription_mutex_);
  const bool wanted =
      markers_.getNumSubscribers() + labels_.getNumSubscribers() > 0 || sender_.is_subscribed();
  if (wanted == subscribed_ || ended_) return;
  subscribed_ = wanted;
  if (rig_) {
    rig_->subscribe(wanted);
  } else if (wanted) {
    points_ =
        topics_.subscribe("points", 2, &ClusterVolumes::receive, this, ros::TransportHints().tcpNoDelay());
  } else {
    points_.shutdown();
  }
}

void ClusterVolumes::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  Frame frame;
  frame.taken = std::chrono::steady_clock::now();
  frame.header.seq = cloud->header.seq;
  frame.header.stamp_ns = frame.recorded_ns = static_cast<std::int64_t>(ros::Time::now().toNSec());
  try {
    read_cloud(cloud, class_field_, frame);
  } catch (const std::exception& error) {
    runner_->report_unreadable(std::move(frame), reason_of(error));
    return;
  }
  frame.header.stamp_ns = stamps_.next(frame.header.stamp_ns, frame.recorded_ns);
  for (const std::string& line : stamps_.take_warnings())
    ROS_WARN_STREAM(name_ << ": " << line);
  runner_->push(std::move(frame));
}

// Publishes shared pointers, so that nodelets in the same manager receive the messages without a copy.
void ClusterVolumes::publish(const Frame& frame, const FrameResult& result) {
  if (!frame.note.empty()) ROS_WARN_STREAM_THROTTLE(60, message_line(name_ + ": " + frame.note));
  for (const std::string& warning : result.warnings)
    ROS_WARN_STREAM(message_line(name_ + ": " + warning));
  if (labels_.getNumSubscribers() > 0) {
    const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
    fill_points(frame, result, *cloud);
    labels_.publish(cloud);
  }
  const std::int64_t lifetime = lifetime_.next(frame.header.stamp_ns);
  if (markers_.getNumSubscribers() > 0) {
    const auto markers = boost::make_shared<visualization_msgs::MarkerArray>();
    fill_markers(frame, result, viewer_shapes(result), lifetime, shown_, *markers);
    markers_.publish(markers);
  }
  publish_adapters(frame, result);
  if (!health_.record_frame(frame, result)) return;
  const auto array = boost::make_shared<diagnostic_msgs::DiagnosticArray>();
  health_.fill(frame, *array);
  array->status.front().name = name_ + ": objects in clouds";
  diagnostics_.publish(array);
}

void ClusterVolumes::publish_adapters(Frame frame, const FrameResult& result) {
  if (frame.header.frame_id.empty()) frame.header.frame_id = "lidar";
  for (const auto& adapter : adapters_)
    adapter->write(frame, result);
}

}  // namespace pcl_bv
