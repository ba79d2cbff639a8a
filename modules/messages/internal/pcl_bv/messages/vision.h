// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Further messages of vision_msgs: boxes and labels, and the detections of ROS 1. types.h describes
// each_field().
#pragma once

#include "pcl_bv/messages/results.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// vision_msgs/msg/BoundingBox3DArray.
struct BoundingBox3DArray {
  static constexpr const char* ros_type = "vision_msgs/msg/BoundingBox3DArray";
  Header header;
  std::vector<BoundingBox3D> boxes;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.boxes);
  }
};

/// vision_msgs/msg/VisionClass.
struct VisionClass {
  std::uint16_t class_id = 0;
  std::string class_name;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.class_id, m.class_name);
  }
};

/// vision_msgs/msg/LabelInfo, of vision_msgs 4.1 and later.
struct LabelInfo {
  static constexpr const char* ros_type = "vision_msgs/msg/LabelInfo";
  Header header;
  std::vector<VisionClass> class_map;
  float threshold = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.class_map, m.threshold);
  }
};

/// vision_msgs/ObjectHypothesisWithPose of ROS 1.
struct Ros1Hypothesis {
  std::int64_t id = -1;  ///< Class of the object.
  double score = 0;
  PoseWithCovariance pose;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.id, m.score, m.pose);
  }
};

/// vision_msgs/Detection3D of ROS 1.
struct Ros1Detection3D {
  Header header;
  std::vector<Ros1Hypothesis> results;
  BoundingBox3D bbox;
  PointCloud2 source_cloud;  ///< The points of the object.
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.results, m.bbox, m.source_cloud);
  }
};

/// vision_msgs/Detection3DArray of ROS 1. Its encoding in CDR is of no type of ROS 2.
struct Ros1Detection3DArray {
  static constexpr const char* ros_type = "vision_msgs/msg/Detection3DArray";
  Header header;
  std::vector<Ros1Detection3D> detections;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.detections);
  }
};

}  // namespace msg
}  // namespace pcl_bv
