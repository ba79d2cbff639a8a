// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// ROS messages that are read or written, and the types of their fields. The names are those of ROS Humble and
// later. Each struct has each_field(message, visit), which calls visit(a, b, ...) with the fields of the
// message in their order. If Visit::ros1 is true, the fields are those of ROS 1. The readers and writers of
// serialize.h use each_field().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// A non-owning view of a field of type uint8[]. With a vector instead, a cloud's points would be copied.
struct Bytes {
  const std::byte* data = nullptr;
  std::size_t size = 0;
};

/// builtin_interfaces/msg/Time.
struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.sec, m.nanosec);
  }
};
/// builtin_interfaces/msg/Duration.
using Duration = Time;

/// Converts nanoseconds since 1970 to a time. Times outside the range of 32-bit seconds are clamped.
Time time_of(std::int64_t nanoseconds);
/// Converts a time to nanoseconds since 1970.
std::int64_t nanoseconds_of(const Time& time);

/// std_msgs/msg/Header.
struct Header {
  static constexpr const char* ros_type = "std_msgs/msg/Header";
  Time stamp;
  std::string frame_id;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    if constexpr (Visit::ros1) {
      std::uint32_t seq = 0;
      visit(seq);
    }
    visit(m.stamp, m.frame_id);
  }
};

/// geometry_msgs/msg/Point.
struct Point {
  double x = 0, y = 0, z = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.x, m.y, m.z);
  }
};
/// geometry_msgs/msg/Vector3.
using Vector3 = Point;

/// geometry_msgs/msg/Quaternion.
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.x, m.y, m.z, m.w);
  }
};

/// geometry_msgs/msg/Pose.
struct Pose {
  Point position;
  Quaternion orientation;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.position, m.orientation);
  }
};

/// geometry_msgs/msg/PoseWithCovariance.
struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};  ///< Row-major, for x, y, z and the rotations about these axes.
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.pose, m.covariance);
  }
};

/// sensor_msgs/msg/PointField.
struct PointField {
  enum : std::uint8_t { INT8 = 1, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64 };
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = FLOAT32;
  std::uint32_t count = 1;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.name, m.offset, m.datatype, m.count);
  }
};

/// sensor_msgs/msg/PointCloud2.
struct PointCloud2 {
  static constexpr const char* ros_type = "sensor_msgs/msg/PointCloud2";
  Header header;
  std::uint32_t height = 1, width = 0;
  std::vector<PointField> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;
  Bytes data;
  bool is_dense = false;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.height, m.width, m.fields, m.is_bigendian, m.point_step, m.row_step, m.data,
          m.is_dense);
  }
};

/// geometry_msgs/msg/Transform.
struct Transform {
  Vector3 translation;
  Quaternion rotation;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.translation, m.rotation);
  }
};

/// geometry_msgs/msg/TransformStamped.
struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.child_frame_id, m.transform);
  }
};

/// tf2_msgs/msg/TFMessage.
struct TFMessage {
  static constexpr const char* ros_type = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.transforms);
  }
};

/// diagnostic_msgs/msg/KeyValue and foxglove_msgs/msg/KeyValuePair.
struct KeyValue {
  std::string key, value;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.key, m.value);
  }
};

/// diagnostic_msgs/msg/DiagnosticStatus.
struct DiagnosticStatus {
  enum : std::uint8_t { OK = 0, WARN, ERROR, STALE };
  std::uint8_t level = OK;
  std::string name, message, hardware_id;
  std::vector<KeyValue> values;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.level, m.name, m.message, m.hardware_id, m.values);
  }
};

/// diagnostic_msgs/msg/DiagnosticArray.
struct DiagnosticArray {
  static constexpr const char* ros_type = "diagnostic_msgs/msg/DiagnosticArray";
  Header header;
  std::vector<DiagnosticStatus> status;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.status);
  }
};

}  // namespace msg
}  // namespace pcl_bv
