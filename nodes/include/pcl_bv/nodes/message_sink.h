// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Results as ROS 2's messages, for whatever carries them: a recording, a middleware, viewers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_sink.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Called by one thread.
class MessageCarrier {
 public:
  virtual ~MessageCarrier() = default;

  /// Once for each topic ("/bv/objects", "vision_msgs/msg/Detection3DArray"), before its first message; its number
  /// from here on.
  virtual std::size_t add_topic(const std::string& name, const std::string& type) = 0;

  /// Whether somebody would get the next message; what nobody wants is not made.
  virtual bool wanted(std::size_t /*topic*/) const { return true; }

  /// A message as plain CDR with its encapsulation; throws as FrameSink::write().
  virtual void send(std::size_t topic, std::int64_t stamp_ns, const std::vector<std::byte>& cdr) = 0;

  /// The settings in force from here on, as to_yaml() writes them.
  virtual void settings(const std::string& /*yaml*/, std::int64_t /*stamp_ns*/) {}

  /// As FrameSink::close().
  virtual void close() {}
};

struct MessageTopics {
  std::string prefix = "/bv";  ///< Before "/objects", "/markers", "/scene" and "/points".
  bool points = false;         ///< The clouds with labels.
  bool scene = true;           ///< foxglove_msgs/msg/SceneUpdate.
  bool poses = true;           ///< Of the sensor in "map", where they are known, on "/tf".
};

/// Sends objects (vision_msgs 4 Detection3DArray), markers (MarkerArray of Humble and later), what `topics` asks for, and
/// "/diagnostics" once a second of the stream's time. A frame without a frame_id is in "lidar", since viewers need one.
std::unique_ptr<FrameSink> make_message_sink(std::unique_ptr<MessageCarrier> carrier, const MessageTopics& topics = {});

}  // namespace pcl_bv
