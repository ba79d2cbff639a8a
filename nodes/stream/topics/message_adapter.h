// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Messages for single other programs, in addition to those of make_message_sink().
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/frame_result.h"
#include "stream/middleware.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Turns results into the messages of one program. Called by one thread.
class MessageAdapter {
 public:
  virtual ~MessageAdapter() = default;

  /// Sends the messages of a frame to the topics that have subscribers. The frame has a frame_id. Numbers
  /// that are not finite are never sent: their objects are left out. Throws as MessageSender::send().
  virtual void write(const Frame& frame, const FrameResult& result) = 0;

  /// Sends what ends the stream. Throws as MessageSender::send().
  virtual void close() {}
};

/// An entry of the table of adapters.
struct AdapterKind {
  std::string_view name;  ///< "moveit": the option of a sink, "mcap:FILE,moveit".
  /// Adds the topics to the sender. Their names begin with the prefix. The sender must outlive the adapter.
  std::unique_ptr<MessageAdapter> (*make)(MessageSender& to, const std::string& prefix);
};

/// Returns the table of adapters.
const std::vector<AdapterKind>& adapter_kinds();

/// Returns the adapter with a name. Throws std::invalid_argument with all names if there is none.
const AdapterKind& adapter_kind(std::string_view name);

/// Returns a topic with a message for each object, all of which may wait for a slow subscriber.
MessageTopic topic_of_objects(const std::string& name);

/// moveit_msgs/msg/PlanningScene on "/planning_scene" and moveit_msgs/msg/CollisionObject on
/// "/collision_object".
std::unique_ptr<MessageAdapter> make_moveit_adapter(MessageSender& to, const std::string& prefix);

/// nav2_dynamic_msgs/msg/ObstacleArray on "/obstacles", and the footprints of objects, one a message, as
/// geometry_msgs/msg/PolygonInstanceStamped on "/polygons" and as geometry_msgs/msg/PolygonStamped on
/// "/footprints". ROS 1: only "/footprints".
std::unique_ptr<MessageAdapter> make_nav2_adapter(MessageSender& to, const std::string& prefix);

/// vision_msgs/msg/BoundingBox3DArray on "/boxes", vision_msgs/msg/LabelInfo on "/label_info" if points have
/// classes, and on "/detection_points" a sensor_msgs/msg/PointCloud2 with the points of all objects and the
/// index of the detection of each. ROS 1: "/boxes", and detections with their points on "/objects".
std::unique_ptr<MessageAdapter> make_vision_adapter(MessageSender& to, const std::string& prefix);

/// A topic to which an adapter sends messages of one type.
template <class Message>
class AdapterTopic {
 public:
  AdapterTopic(MessageSender& to, const std::string& name) : AdapterTopic(to, MessageTopic{name, {}}) {}
  /// `topic` has no type yet.
  AdapterTopic(MessageSender& to, MessageTopic topic) : to_(to) {
    topic.type = Message::ros_type;
    index_ = to.add_topic(topic);
  }

  bool has_subscribers() const { return to_.has_subscribers(index_); }

  void send(std::int64_t stamp_ns, const Message& message) {
    bytes_.clear();
    if (to_.takes_ros1()) {
      write_ros1(message, bytes_);
    } else {
      write_cdr(message, bytes_);
    }
    to_.send(index_, stamp_ns, bytes_);
  }

 private:
  MessageSender& to_;
  std::size_t index_;
  std::vector<std::byte> bytes_;
};

}  // namespace detail
}  // namespace pcl_bv
