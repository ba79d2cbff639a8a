// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What carries messages: recordings, viewers, and modules that are only loaded where they are used.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "pcl_bv/nodes/remote_settings.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct MessageTopic {
  std::string name;              ///< "/bv/objects".
  std::string type;              ///< "vision_msgs/msg/Detection3DArray".
  std::string encoding = "cdr";  ///< Or "json", of carriers for viewers.
};

/// Called by one thread.
class MessageCarrier {
 public:
  virtual ~MessageCarrier() = default;

  /// Once for each topic, before its first message; its number from here on.
  virtual std::size_t add_topic(const MessageTopic& topic) = 0;

  /// Whether somebody would get the next message; what nobody wants is not made.
  virtual bool wanted(std::size_t /*topic*/) const { return true; }

  /// A message, as plain CDR with its encapsulation or as a text; throws as FrameSink::write().
  virtual void send(std::size_t topic, std::int64_t stamp_ns, const std::vector<std::byte>& message) = 0;

  /// The settings in force from here on, as to_yaml() writes them.
  virtual void settings(const std::string& /*yaml*/, std::int64_t /*stamp_ns*/) {}

  /// As FrameSink::offer().
  virtual void offer(const std::shared_ptr<RemoteSettings>& /*settings*/) {}

  /// Something that people should know now: a line.
  virtual void notice(const std::string& /*line*/) {}

  /// As FrameSink::take_remarks().
  virtual std::vector<std::string> take_remarks() { return {}; }

  /// As FrameSink::close().
  virtual void close() {}
};

struct ReceivedMessage {
  const std::byte* data = nullptr;  ///< Plain CDR with its encapsulation.
  std::size_t size = 0;
  std::shared_ptr<const void> owner;  ///< Keeps the bytes.
  std::int64_t sent_ns = 0;  ///< When it was sent, nanoseconds of the sender's system time.
};

/// Of one topic. Called by one thread.
class MessageReceiver {
 public:
  virtual ~MessageReceiver() = default;

  /// The next message if it comes within `patience`. Which are lost if it is not called often enough is the
  /// receiver's choice, and is said in its remarks.
  virtual bool next(ReceivedMessage& message, std::chrono::milliseconds patience) = 0;

  /// As FrameSource::take_remarks().
  virtual std::vector<std::string> take_remarks() { return {}; }
};

class Middleware {
 public:
  virtual ~Middleware() = default;

  /// Of a topic ("/points") with messages of a type ("sensor_msgs/msg/PointCloud2"). Throws IoError where the network
  /// cannot be used, std::invalid_argument for what is no name of a topic and for bad values in the environment.
  virtual std::unique_ptr<MessageReceiver> receiver(const std::string& topic, const std::string& type) = 0;

  /// `place` says where, to those that have to be told ("localhost:8765"). Throws as receiver().
  virtual std::unique_ptr<MessageCarrier> carrier(const std::string& place) = 0;
};

/// "dds": ROS 2's topics by Eclipse Cyclone DDS; docs/ros.md says what of the environment it heeds. "ws": WebSockets for
/// Foxglove's viewers and our page, a carrier only; docs/live.md. Loaded from
/// pcl_bv/pcl_bv_NAME.so in the folder of libraries beside the program or beside this library, and never unloaded. Throws
/// IoError where it is not installed or of another version.
Middleware& middleware(const std::string& name);

/// What a module has, as `extern "C"`: its version, that of the library, and itself.
using MiddlewareVersion = const char* (*)();
using MiddlewareInstance = Middleware* (*)();
inline constexpr const char* kMiddlewareVersion = "pcl_bv_middleware_version";
inline constexpr const char* kMiddlewareInstance = "pcl_bv_middleware";

}  // namespace pcl_bv
