// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Messages about moving obstacles, of nav2_dynamic_msgs. types.h describes each_field().
#pragma once

#include "pcl_bv/messages/types.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// nav2_dynamic_msgs/msg/Obstacle, with the covariances that it has since June 2024.
struct Obstacle {
  std::array<std::uint8_t, 16> uuid{};  ///< unique_identifier_msgs/msg/UUID.
  float score = 0;                      ///< Confidence of the detection, 0 to 1.
  Point position;                       ///< Centre.
  Vector3 velocity;                     ///< Metres per second.
  Vector3 size;                         ///< Full lengths along the axes of the header's frame, metres.
  std::array<double, 9> position_covariance{}, velocity_covariance{};  ///< Row-major, for x, y and z.
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.uuid, m.score, m.position, m.velocity, m.size, m.position_covariance, m.velocity_covariance);
  }
};

/// nav2_dynamic_msgs/msg/ObstacleArray.
struct ObstacleArray {
  static constexpr const char* ros_type = "nav2_dynamic_msgs/msg/ObstacleArray";
  Header header;
  std::vector<Obstacle> obstacles;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.obstacles);
  }
};

}  // namespace msg
}  // namespace pcl_bv
