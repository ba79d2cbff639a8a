// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>

#include "pcl_bv/messages/schema.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/settings.h"
#include "pcl_bv/recording/mcap_writer.h"
#include "pcl_bv/recording/rosbag2_writer.h"
#include "sinks.h"
#include "topics/scene.h"

namespace pcl_bv {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

// What rosbag2 notes of a topic: reliable, the last ten, nothing for those who come later.
constexpr const char* kQos =
    "- history: 1\n  depth: 10\n  reliability: 1\n  durability: 2\n  deadline:\n    sec: 9223372036\n    "
    "nsec: "
    "854775807\n  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n  liveliness: 1\n  "
    "liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n  "
    "avoid_ros_namespace_conventions: false";

class RecordingSink final : public FrameSink {
 public:
  RecordingSink(std::unique_ptr<RecordingWriter> writer, bool points)
      : writer_(std::move(writer)), points_(points) {
    objects_topic_ = add("/bv/objects", msg::Detection3DArray::ros_type);
    markers_topic_ = add("/bv/markers", msg::MarkerArray::ros_type);
    scene_topic_ = add("/bv/scene", msg::SceneUpdate::ros_type);
    diagnostics_topic_ = add("/diagnostics", msg::DiagnosticArray::ros_type);
    if (points_) points_topic_ = add("/bv/points", msg::PointCloud2::ros_type);
  }

  void write(const Frame& original, const FrameResult& result) override {
    Frame frame = original;
    if (frame.header.frame_id.empty()) frame.header.frame_id = "lidar";  // viewers need one
    note_settings(result, frame.header.stamp_ns);
    if (points_) {
      fill_points(frame, result, cloud_bytes_, cloud_);
      send(points_topic_, frame, cloud_);
    }
    const std::int64_t lifetime = lifetime_of(frame.header.stamp_ns);
    fill_detections(frame, result, objects_);
    send(objects_topic_, frame, objects_);
    const std::vector<DrawnVolume> volumes = drawn(result);
    fill_markers(frame, result, volumes, lifetime, shown_markers_, markers_);
    send(markers_topic_, frame, markers_);
    fill_scene(frame, result, volumes, lifetime, shown_entities_, scene_);
    send(scene_topic_, frame, scene_);
    if (frame.pose) send_pose(frame);
    diagnose(frame, result);
  }

  void write_lost(const Frame&, const std::string&) override { ++lost_; }
  void close() override { writer_->close(); }

 private:
  std::size_t add(const char* name, const char* type) {
    return writer_->add_topic({name, type, schema_of(type), {{"offered_qos_profiles", kQos}}});
  }

  template <class Message>
  void send(std::size_t topic, const Frame& frame, const Message& message) {
    bytes_.clear();
    write_cdr(message, bytes_);
    writer_->write(topic, frame.header.stamp_ns, frame.header.stamp_ns, bytes_.data(), bytes_.size());
  }

  // As they are for the first frame, and again when they change.
  void note_settings(const FrameResult& result, std::int64_t stamp_ns) {
    if (noted_ == result.config) return;
    noted_ = result.config;
    StreamConfig config;
    config.pipeline = *result.config;
    writer_->attach("config.yaml", "application/yaml", to_yaml(config), stamp_ns);
  }

  // Three periods: who misses a frame still sees its objects.
  std::int64_t lifetime_of(std::int64_t stamp_ns) {
    const std::int64_t step = stamp_ns - std::exchange(last_stamp_ns_, stamp_ns);
    if (frames_++ > 0 && step > 0) period_ns_ = std::min(step, 2 * kSecond);
    return 3 * period_ns_;
  }

  void send_pose(const Frame& frame) {
    if (!pose_topic_) pose_topic_ = add("/tf", msg::TFMessage::ros_type);
    const Eigen::Quaterniond turn(frame.pose->linear());
    const Eigen::Vector3d at = frame.pose->translation();
    msg::TransformStamped transform;
    topics::set_time(frame.header.stamp_ns, transform.header.stamp);
    transform.header.frame_id = "map";
    transform.child_frame_id = frame.header.frame_id;
    transform.transform = {{at.x(), at.y(), at.z()}, {turn.x(), turn.y(), turn.z(), turn.w()}};
    send(*pose_topic_, frame, msg::TFMessage{{transform}});
  }

  // Once a second of the stream's time.
  void diagnose(const Frame& frame, const FrameResult& result) {
    slowest_ms_ = std::max(slowest_ms_, result.ms.total);
    const std::int64_t since = frame.header.stamp_ns - diagnosed_ns_;
    if (frames_ > 1 && since >= 0 && since < kSecond) return;
    diagnosed_ns_ = frame.header.stamp_ns;
    msg::DiagnosticArray array;
    topics::set_header(frame, array.header);
    msg::DiagnosticStatus status;
    status.level = lost_ > 0 ? msg::DiagnosticStatus::WARN : msg::DiagnosticStatus::OK;
    status.name = "pcl_bv";
    status.message = lost_ > 0 ? "frames were lost" : "running";
    status.values = {{"frames", std::to_string(frames_)},
                     {"lost", std::to_string(lost_)},
                     {"objects", std::to_string(result.clusters.size())},
                     {"slowest_ms", to_text(slowest_ms_)}};
    array.status = {status};
    send(diagnostics_topic_, frame, array);
    slowest_ms_ = 0;
  }

  std::unique_ptr<RecordingWriter> writer_;
  bool points_;
  std::size_t objects_topic_ = 0, markers_topic_ = 0, scene_topic_ = 0, diagnostics_topic_ = 0,
              points_topic_ = 0;
  std::optional<std::size_t> pose_topic_;
  std::shared_ptr<const PipelineConfig> noted_;
  msg::Detection3DArray objects_;
  msg::MarkerArray markers_;
  msg::SceneUpdate scene_;
  msg::PointCloud2 cloud_;
  std::vector<std::byte> cloud_bytes_, bytes_;
  ShownObjects shown_markers_, shown_entities_;
  std::uint64_t frames_ = 0, lost_ = 0;
  std::int64_t last_stamp_ns_ = 0, period_ns_ = kSecond / 10, diagnosed_ns_ = 0;
  double slowest_ms_ = 0;
};

}  // namespace

std::unique_ptr<FrameSink> open_mcap_sink(const SinkDescription& description) {
  return std::make_unique<RecordingSink>(std::make_unique<McapWriter>(description.place), description.points);
}

std::unique_ptr<FrameSink> open_rosbag2_sink(const SinkDescription& description) {
  return std::make_unique<RecordingSink>(std::make_unique<Rosbag2Writer>(description.place),
                                         description.points);
}

}  // namespace pcl_bv
