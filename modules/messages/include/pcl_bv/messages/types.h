// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The messages of ROS that we read, and what others are made of, with ROS's own names. Each has
// each_field(message, visit), which calls visit(a, b, ...) with its fields in their order: what writes and reads
// messages (serialize.h) walks over that. Humble and later; with Visit::ros1 as ROS 1 has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// uint8[] that lies elsewhere: a cloud is read, and written, without a copy.
struct Bytes {
  const std::byte* data = nullptr;
  std::size_t size = 0;
};

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.sec, m.nanosec);
  }
};
using Duration = Time;

/// Nanoseconds since 1970, and back. Seconds beyond 32 bits are cut to the nearest that fits.
Time time_of(std::int64_t nanoseconds);
std::int64_t nanoseconds_of(const Time& time);

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

struct Point {
  double x = 0, y = 0, z = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.x, m.y, m.z);
  }
};
using Vector3 = Point;

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.x, m.y, m.z, m.w);
  }
};

struct Pose {
  Point position;
  Quaternion orientation;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.position, m.orientation);
  }
};

struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};  ///< Row by row of x, y, z and rotations about them.
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.pose, m.covariance);
  }
};

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

struct Transform {
  Vector3 translation;
  Quaternion rotation;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.translation, m.rotation);
  }
};

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.child_frame_id, m.transform);
  }
};

struct TFMessage {
  static constexpr const char* ros_type = "tf2_msgs/msg/TFMessage";
  std::vector<TransformStamped> transforms;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.transforms);
  }
};

struct KeyValue {
  std::string key, value;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.key, m.value);
  }
};

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
