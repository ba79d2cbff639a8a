// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Messages about footprints, of geometry_msgs. types.h describes each_field().
#pragma once

#include "pcl_bv/messages/types.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// geometry_msgs/msg/Point32.
struct Point32 {
  float x = 0, y = 0, z = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.x, m.y, m.z);
  }
};

/// geometry_msgs/msg/Polygon.
struct Polygon {
  std::vector<Point32> points;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.points);
  }
};

/// geometry_msgs/msg/PolygonStamped.
struct PolygonStamped {
  static constexpr const char* ros_type = "geometry_msgs/msg/PolygonStamped";
  Header header;
  Polygon polygon;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.polygon);
  }
};

/// geometry_msgs/msg/PolygonInstance.
struct PolygonInstance {
  Polygon polygon;
  std::int64_t id = 0;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.polygon, m.id);
  }
};

/// geometry_msgs/msg/PolygonInstanceStamped, of Jazzy and later.
struct PolygonInstanceStamped {
  static constexpr const char* ros_type = "geometry_msgs/msg/PolygonInstanceStamped";
  Header header;
  PolygonInstance polygon;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.polygon);
  }
};

}  // namespace msg
}  // namespace pcl_bv
