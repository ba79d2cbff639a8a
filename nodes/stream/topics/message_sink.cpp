// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "message_sink.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "message_adapter.h"
#include "pcl_bv/messages/serialize.h"
#include "pipeline/config/settings.h"
#include "scene.h"

namespace pcl_bv::detail {
namespace {

constexpr const char* kFrameType = "pcl_bv.Frame";

class MessageSink final : public FrameSink {
 public:
  MessageSink(std::unique_ptr<MessageSender> carrier, const MessageTopics& topics)
      : carrier_(std::move(carrier)), sends_poses_(topics.poses) {
    objects_topic_ = carrier_->add_topic({topics.prefix + "/objects", msg::Detection3DArray::ros_type});
    markers_topic_ = carrier_->add_topic({topics.prefix + "/markers", msg::MarkerArray::ros_type});
    if (topics.scene)
      scene_topic_ = carrier_->add_topic({topics.prefix + "/scene", msg::SceneUpdate::ros_type});
    diagnostics_topic_ = carrier_->add_topic({"/diagnostics", msg::DiagnosticArray::ros_type});
    if (topics.points)
      points_topic_ = carrier_->add_topic({topics.prefix + "/points", msg::PointCloud2::ros_type});
    for (const std::string& name : topics.adapters)
      adapters_.push_back(adapter_kind(name).make(*carrier_, topics.prefix));
    if (topics.frames) frames_topic_ = carrier_->add_topic({topics.prefix + "/frames", kFrameType, "json"});
  }

  void write(const Frame& original, const FrameResult& result) override {
    Frame frame = original;
    if (frame.header.frame_id.empty()) frame.header.frame_id = "lidar";
    note_settings(result, frame.header.stamp_ns);
    if (has_subscribers(points_topic_)) {
      topics::set_labelled(frame, result, cloud_);
      cloud_bytes_.resize(std::size_t{cloud_.point_step} * cloud_.width);
      write_labelled_points(frame, result, cloud_bytes_.data());
      cloud_.data = {cloud_bytes_.data(), cloud_bytes_.size()};
      send(*points_topic_, frame, cloud_);
    }
    const std::int64_t lifetime = lifetime_.next(frame.header.stamp_ns);
    if (has_subscribers(objects_topic_)) {
      fill_detections(frame, result, objects_);
      send(*objects_topic_, frame, objects_);
    }
    draw(frame, result, lifetime);
    for (const auto& adapter : adapters_)
      adapter->write(frame, result);
    if (has_subscribers(frames_topic_))
      send_frame(report_without_clusters(frame, result), cluster_source(result));
    if (frame.pose && sends_poses_) send_pose(frame);
    const bool due = health_.record_frame(frame, result);
    if (due && has_subscribers(diagnostics_topic_)) {
      msg::DiagnosticArray array;
      health_.fill(frame, array);
      send(*diagnostics_topic_, frame, array);
    }
  }

  void write_lost(const Frame& frame, const std::string& reason) override {
    health_.count_lost();
    carrier_->notify("frame " + std::to_string(frame.header.seq) + " is lost: " + reason);
    if (has_subscribers(frames_topic_)) send_frame(report_of_lost(frame, reason), {});
  }
  void offer_settings(const std::shared_ptr<RemoteParameters>& settings) override {
    settings_ = settings;
    carrier_->offer_settings(settings);
  }
  std::vector<std::string> take_warnings() override { return carrier_->take_warnings(); }
  void close() override {
    try {
      for (const auto& adapter : adapters_)
        adapter->close();
    } catch (...) {
      carrier_->close();
      throw;
    }
    carrier_->close();
  }

 private:
  using Topic = std::optional<std::size_t>;

  bool has_subscribers(Topic topic) const { return topic && carrier_->has_subscribers(*topic); }

  template <class Message>
  void send(std::size_t topic, const Frame& frame, const Message& message) {
    bytes_.clear();
    write_cdr(message, bytes_);
    carrier_->send(topic, frame.header.stamp_ns, bytes_);
  }

  void send_frame(const FrameReport& report, const ClusterSource& clusters) {
    const std::string text = frame_json(report, clusters);
    const auto* const first = reinterpret_cast<const std::byte*>(text.data());
    bytes_.assign(first, first + text.size());
    carrier_->send(*frames_topic_, report.stamp_ns, bytes_);
  }

  void draw(const Frame& frame, const FrameResult& result, std::int64_t lifetime) {
    const bool markers = has_subscribers(markers_topic_), scene = has_subscribers(scene_topic_);
    if (!markers && !scene) return;
    const std::vector<VolumeShape> volumes = viewer_shapes(result);
    if (markers) {
      fill_markers(frame, result, volumes, lifetime, shown_markers_, markers_);
      send(*markers_topic_, frame, markers_);
    }
    if (scene) {
      fill_scene(frame, result, volumes, lifetime, shown_entities_, scene_);
      send(*scene_topic_, frame, scene_);
    }
  }

  // Sends the settings with the first frame and whenever they change.
  void note_settings(const FrameResult& result, std::int64_t stamp_ns) {
    if (noted_ == result.config) return;
    noted_ = result.config;
    StreamConfig config = settings_ ? settings_->stream() : StreamConfig();
    config.pipeline = *result.config;
    // Volumes without a file, such as the robot's body, have no text.
    std::erase_if(config.pipeline.filter.regions,
                  [](const RegionConfig& region) { return region.file.empty(); });
    carrier_->announce_settings(to_yaml(config), stamp_ns);
  }

  void send_pose(const Frame& frame) {
    if (!pose_topic_) pose_topic_ = carrier_->add_topic({"/tf", msg::TFMessage::ros_type});
    const Eigen::Quaterniond rotation(frame.pose->linear());
    const Eigen::Vector3d at = frame.pose->translation();
    msg::TransformStamped transform;
    topics::set_time(frame.header.stamp_ns, transform.header.stamp);
    transform.header.frame_id = frame.fixed_frame.empty() ? "map" : frame.fixed_frame;
    transform.child_frame_id = frame.header.frame_id;
    transform.transform = {{at.x(), at.y(), at.z()},
                           {rotation.x(), rotation.y(), rotation.z(), rotation.w()}};
    send(*pose_topic_, frame, msg::TFMessage{{transform}});
  }

  std::unique_ptr<MessageSender> carrier_;
  bool sends_poses_;
  Topic objects_topic_, markers_topic_, scene_topic_, diagnostics_topic_, points_topic_, frames_topic_,
      pose_topic_;
  std::shared_ptr<const PipelineConfig> noted_;
  std::shared_ptr<RemoteParameters> settings_;  // null if none are offered
  msg::Detection3DArray objects_;
  msg::MarkerArray markers_;
  msg::SceneUpdate scene_;
  msg::PointCloud2 cloud_;
  std::vector<std::byte> cloud_bytes_, bytes_;
  std::vector<std::unique_ptr<MessageAdapter>> adapters_;
  ShownObjects shown_markers_, shown_entities_;
  MarkerLifetime lifetime_;
  StreamHealth health_;
};

}  // namespace

std::unique_ptr<FrameSink> make_message_sink(std::unique_ptr<MessageSender> carrier,
                                             const MessageTopics& topics) {
  if (carrier == nullptr) throw std::invalid_argument("make_message_sink: no carrier");
  return std::make_unique<MessageSink>(std::move(carrier), topics);
}

}  // namespace pcl_bv::detail
