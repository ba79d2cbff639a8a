// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sends the boxes, points and class names of detections in the types of vision_msgs. Detections of ROS 1
// contain their points. Those of vision_msgs 3 and later do not, so that the points have a topic of their
// own.

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

#include "message_adapter.h"
#include "pcl_bv/messages/finite.h"
#include "pcl_bv/messages/vision.h"
#include "pcl_bv/nodes/topics.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

// A cloud of x, y, z, `detection`, which is the index of the detection, and, if known, the intensity.
class DetectionCloud {
 public:
  explicit DetectionCloud(const Frame& frame) : frame_(frame) {
    topics::set_header(frame, cloud_.header);
    const std::uint32_t fields = frame.intensity ? 5 : 4;
    for (std::uint32_t i = 0; i < fields; ++i) {
      const char* const name = std::array<const char*, 5>{"x", "y", "z", "detection", "intensity"}[i];
      cloud_.fields.push_back({name, 4 * i, i == 3 ? msg::PointField::UINT32 : msg::PointField::FLOAT32, 1});
    }
    cloud_.point_step = 4 * fields;
    cloud_.is_dense = true;
  }

  // Appends the points of a cluster with finite coordinates.
  void add(const FrameResult& result, std::uint32_t cluster) {
    const PointView points = result.points_of(cluster, result.cloud_of(frame_));
    for (std::size_t chunk = 0; chunk < chunk_count(points.count); ++chunk) {
      const LoadedPoints loaded = load_chunk(points, chunk);
      const PointView& part = loaded.view();
      for (std::size_t i = 0; i < part.count; ++i) {
        const Coordinates p = load_point(part, i);
        const float xyz[] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        if (!std::isfinite(xyz[0]) || !std::isfinite(xyz[1]) || !std::isfinite(xyz[2])) continue;
        std::array<std::byte, 20> row;
        std::memcpy(row.data(), xyz, sizeof xyz);
        std::memcpy(row.data() + 12, &cluster, 4);
        if (frame_.intensity) {
          const float measured = frame_.intensity->at(part.index(i));
          const float intensity = std::isfinite(measured) ? measured : 0;
          std::memcpy(row.data() + 16, &intensity, 4);
        }
        bytes_.insert(bytes_.end(), row.begin(), row.begin() + cloud_.point_step);
      }
    }
  }

  // Returns the message. It refers to this object.
  const msg::PointCloud2& message() {
    if (bytes_.size() > std::numeric_limits<std::uint32_t>::max())
      throw std::length_error("the points of the detections have more than 4 GiB");
    cloud_.row_step = static_cast<std::uint32_t>(bytes_.size());
    cloud_.width = cloud_.row_step / cloud_.point_step;
    cloud_.data = {bytes_.data(), bytes_.size()};
    return cloud_;
  }

 private:
  const Frame& frame_;
  msg::PointCloud2 cloud_;
  std::vector<std::byte> bytes_;
};

// Returns the detections of a frame. A box with a number that is not finite becomes the empty box at the
// origin, so that all lists keep the order of the clusters.
msg::Detection3DArray detections_of(const Frame& frame, const FrameResult& result) {
  msg::Detection3DArray array;
  fill_detections(frame, result, array);
  for (msg::Detection3D& detection : array.detections) {
    if (!is_finite(detection.bbox)) detection.bbox = {};
    for (msg::ObjectHypothesisWithPose& hypothesis : detection.results)
      if (!is_finite(hypothesis.pose)) hypothesis.pose = {};
  }
  return array;
}

class VisionAdapter final : public MessageAdapter {
 public:
  VisionAdapter(MessageSender& to, const std::string& prefix) : boxes_(to, prefix + "/boxes") {
    if (to.takes_ros1()) {
      ros1_detections_.emplace(to, prefix + "/objects");
      return;
    }
    points_.emplace(to, prefix + "/detection_points");
    MessageTopic labels{prefix + "/label_info", {}};
    labels.latched = true;
    labels_.emplace(to, labels);
  }

  void write(const Frame& frame, const FrameResult& result) override {
    if (labels_) send_labels(frame, result);
    const bool boxes = boxes_.has_subscribers();
    const bool ros1 = ros1_detections_ && ros1_detections_->has_subscribers();
    if (boxes || ros1) {
      const msg::Detection3DArray array = detections_of(frame, result);
      if (boxes) send_boxes(frame, array);
      if (ros1) send_ros1(frame, result, array);
    }
    if (!points_ || !points_->has_subscribers()) return;
    DetectionCloud cloud(frame);
    for (std::uint32_t i = 0; i < result.clusters.size(); ++i)
      cloud.add(result, i);
    points_->send(frame.header.stamp_ns, cloud.message());
  }

 private:
  void send_boxes(const Frame& frame, const msg::Detection3DArray& array) {
    msg::BoundingBox3DArray boxes;
    boxes.header = array.header;
    for (const msg::Detection3D& detection : array.detections)
      boxes.boxes.push_back(detection.bbox);
    boxes_.send(frame.header.stamp_ns, boxes);
  }

  void send_ros1(const Frame& frame, const FrameResult& result, const msg::Detection3DArray& array) {
    msg::Ros1Detection3DArray of_ros1;
    of_ros1.header = array.header;
    std::vector<DetectionCloud> clouds(array.detections.size(), DetectionCloud(frame));
    for (std::uint32_t i = 0; i < clouds.size(); ++i) {
      const msg::Detection3D& detection = array.detections[i];
      clouds[i].add(result, i);
      msg::Ros1Detection3D& to = of_ros1.detections.emplace_back();
      to.header = detection.header;
      to.bbox = detection.bbox;
      to.source_cloud = clouds[i].message();
      for (const msg::ObjectHypothesisWithPose& hypothesis : detection.results)
        to.results.push_back({result.class_of.empty() ? -1 : result.class_of[i], hypothesis.hypothesis.score,
                              hypothesis.pose});
    }
    ros1_detections_->send(frame.header.stamp_ns, of_ros1);
  }

  // Sends the names of classes with the first frame and whenever the configuration changes.
  void send_labels(const Frame& frame, const FrameResult& result) {
    if (labelled_ == result.config || !result.config->cluster.class_field) return;
    labelled_ = result.config;
    msg::LabelInfo info;
    topics::set_header(frame, info.header);
    for (const ClassConfig& known : result.config->cluster.classes) {
      if (known.name.empty() || known.value < 0 || known.value > std::numeric_limits<std::uint16_t>::max())
        continue;
      info.class_map.push_back({static_cast<std::uint16_t>(known.value), known.name});
    }
    labels_->send(frame.header.stamp_ns, info);
  }

  AdapterTopic<msg::BoundingBox3DArray> boxes_;
  std::optional<AdapterTopic<msg::PointCloud2>> points_;
  std::optional<AdapterTopic<msg::LabelInfo>> labels_;
  std::optional<AdapterTopic<msg::Ros1Detection3DArray>> ros1_detections_;
  std::shared_ptr<const PipelineConfig> labelled_;  // whose classes were sent last
};

}  // namespace

std::unique_ptr<MessageAdapter> make_vision_adapter(MessageSender& to, const std::string& prefix) {
  return std::make_unique<VisionAdapter>(to, prefix);
}

}  // namespace pcl_bv::detail
