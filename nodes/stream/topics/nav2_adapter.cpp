// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sends moving obstacles and footprints to Nav2. ROS 1 has only the type of the footprints.

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "footprints.h"
#include "message_adapter.h"
#include "pcl_bv/messages/finite.h"
#include "pcl_bv/messages/obstacles.h"
#include "pcl_bv/messages/polygon.h"
#include "pcl_bv/nodes/topics.h"

namespace pcl_bv::detail {
namespace {

// Returns a UUID of version 8 (RFC 9562) that is the same for a track in all frames. An object without a
// track gets the UUID of the number of its cluster.
std::array<std::uint8_t, 16> uuid_of(const TrackEntry* track, std::size_t cluster) {
  const auto number = track != nullptr ? track->id : static_cast<std::uint32_t>(cluster);
  std::array<std::uint8_t, 16> uuid{'p', 'c', 'l', '_', 'b', 'v', 0x80, 0, 0x80};
  if (track == nullptr) uuid[7] = 1;
  for (std::size_t byte = 0; byte < 4; ++byte)
    uuid[12 + byte] = static_cast<std::uint8_t>(number >> (24 - 8 * byte));
  return uuid;
}

// Returns the box, along the axes of the points' frame, that the boxes of all volumes have in common. It
// contains all points.
Aabb common_box(const FrameResult& result, std::size_t cluster) {
  std::optional<Aabb> common;
  for (std::size_t m = 0; m < result.methods.size(); ++m) {
    const AnyVolume& volume = result.volume(cluster, m);
    if (!result.is_requested(cluster, m) || empty(volume)) continue;
    const Aabb box = aabb(volume);
    common = common ? Aabb(common->min().cwiseMax(box.min()), common->max().cwiseMin(box.max())) : box;
  }
  return common.value_or(Aabb());
}

std::array<double, 9> row_major(const Eigen::Matrix3d& covariance, const Eigen::Matrix3d& rotation) {
  const Eigen::Matrix3d rotated = rotation * covariance * rotation.transpose();
  std::array<double, 9> list;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i / 3), column = static_cast<Eigen::Index>(i % 3);
    list[i] = rotated(std::min(row, column), std::max(row, column));  // exactly symmetric
  }
  return list;
}

// Tracks have no variance of the vertical velocity: it gets the larger one of the horizontal velocities.
void set_motion(const TrackEntry& track, const Eigen::Matrix3d& rotation, msg::Obstacle& obstacle) {
  const Eigen::Vector3d velocity = rotation * track.velocity;
  obstacle.velocity = {velocity.x(), velocity.y(), velocity.z()};
  const auto& c = track.covariance;  // the upper triangle of x, y, z, yaw, vx, vy
  Eigen::Matrix3d position, motion;
  position << c[0], c[1], c[2], c[1], c[6], c[7], c[2], c[7], c[11];
  motion << c[18], c[19], 0, c[19], c[20], 0, 0, 0, std::max(c[18], c[20]);
  obstacle.position_covariance = row_major(position, rotation);
  obstacle.velocity_covariance = row_major(motion, rotation);
}

class Nav2Adapter final : public MessageAdapter {
 public:
  Nav2Adapter(MessageSender& to, const std::string& prefix)
      : footprints_(to, topic_of_objects(prefix + "/footprints")) {
    if (to.takes_ros1()) return;
    obstacles_.emplace(to, prefix + "/obstacles");
    polygons_.emplace(to, topic_of_objects(prefix + "/polygons"));
  }

  void write(const Frame& frame, const FrameResult& result) override {
    if (obstacles_ && obstacles_->has_subscribers()) send_obstacles(frame, result);
    const bool polygons = polygons_ && polygons_->has_subscribers();
    if (!polygons && !footprints_.has_subscribers()) return;
    std::set<std::int64_t> now(result.active_tracks.begin(), result.active_tracks.end());
    for (const Footprint& footprint : footprints_of(frame, result)) {
      now.insert(footprint.id);
      if (footprints_.has_subscribers()) footprints_.send(frame.header.stamp_ns, footprint.message);
      if (polygons) send_polygon(frame, footprint.message, footprint.id);
    }
    if (polygons) clear_ended(frame, now);
  }

 private:
  void send_polygon(const Frame& frame, const msg::PolygonStamped& footprint, std::int64_t id) {
    polygons_->send(frame.header.stamp_ns, {footprint.header, {footprint.polygon, id}});
    shown_.insert(id);
  }

  // A polygon without points clears the one with its id.
  void clear_ended(const Frame& frame, const std::set<std::int64_t>& now) {
    std::vector<std::int64_t> ended;
    std::set_difference(shown_.begin(), shown_.end(), now.begin(), now.end(), std::back_inserter(ended));
    msg::PolygonStamped cleared;
    topics::set_header(frame, cleared.header);
    for (const std::int64_t id : ended) {
      send_polygon(frame, cleared, id);
      shown_.erase(id);
    }
  }

  void send_obstacles(const Frame& frame, const FrameResult& result) {
    // Velocities of tracks are in the fixed frame if the pose of the sensor is known.
    const Eigen::Matrix3d rotation =
        frame.pose ? Eigen::Matrix3d(frame.pose->linear().transpose()) : Eigen::Matrix3d::Identity();
    msg::ObstacleArray array;
    topics::set_header(frame, array.header);
    for (std::size_t i = 0; i < result.clusters.size(); ++i) {
      const Aabb box = common_box(result, i);
      if (box.empty()) continue;
      const TrackEntry* const track = result.track_of(i);
      const Eigen::Vector3d centre = box.center(), size = box.max() - box.min();
      msg::Obstacle obstacle;
      obstacle.uuid = uuid_of(track, i);
      obstacle.score = 1;
      obstacle.position = {centre.x(), centre.y(), centre.z()};
      obstacle.size = {size.x(), size.y(), size.z()};
      obstacle.position_covariance[0] = obstacle.velocity_covariance[0] = -1;  // unknown
      if (track != nullptr) set_motion(*track, rotation, obstacle);
      if (is_finite(obstacle)) array.obstacles.push_back(obstacle);
    }
    obstacles_->send(frame.header.stamp_ns, array);
  }

  AdapterTopic<msg::PolygonStamped> footprints_;
  std::optional<AdapterTopic<msg::ObstacleArray>> obstacles_;
  std::optional<AdapterTopic<msg::PolygonInstanceStamped>> polygons_;
  std::set<std::int64_t> shown_;  // ids of polygons that were sent and not cleared
};

}  // namespace

std::unique_ptr<MessageAdapter> make_nav2_adapter(MessageSender& to, const std::string& prefix) {
  return std::make_unique<Nav2Adapter>(to, prefix);
}

}  // namespace pcl_bv::detail
