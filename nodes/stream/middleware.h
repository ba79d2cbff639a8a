// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Interfaces for sending messages to recordings, viewers and networks, and for receiving messages. Network
// modules are loaded when they are first used.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "stream/remote_parameters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A topic and the type of its messages.
struct MessageTopic {
  std::string name;              ///< "/bv/objects".
  std::string type;              ///< "vision_msgs/msg/Detection3DArray".
  std::string encoding = "cdr";  ///< "cdr", or "json" for viewers.
  bool latched = false;          ///< Later receivers get the last message, too (Delivery::latched).
  /// Number of messages that are sent again to receivers that missed them, or that wait for slow receivers.
  std::size_t history = 5;
};

/// Sends the messages of several topics. Called by one thread.
class MessageSender {
 public:
  virtual ~MessageSender() = default;

  /// Announces a topic. Called once, before the first message of the topic. Returns the topic's number for
  /// the other member functions.
  virtual std::size_t add_topic(const MessageTopic& topic) = 0;

  /// Returns whether send() takes messages of ROS 1 in its encoding instead of CDR.
  virtual bool takes_ros1() const { return false; }

  /// Returns whether the next message of a topic has a receiver. Without a receiver, the caller need not make
  /// the message.
  virtual bool has_subscribers(std::size_t /*topic*/) const { return true; }

  /// Sends a message: CDR with its encapsulation header, JSON text, or takes_ros1(). Throws as
  /// FrameSink::write().
  virtual void send(std::size_t topic, std::int64_t stamp_ns, const std::vector<std::byte>& message) = 0;

  /// Announces the settings that apply from now on, as a text of to_yaml().
  virtual void announce_settings(const std::string& /*yaml*/, std::int64_t /*stamp_ns*/) {}

  /// Same as FrameSink::offer_settings().
  virtual void offer_settings(const std::shared_ptr<RemoteParameters>& /*settings*/) {}

  /// Shows a line to the viewers.
  virtual void notify(const std::string& /*line*/) {}

  /// Same as FrameSink::take_warnings().
  virtual std::vector<std::string> take_warnings() { return {}; }

  /// Same as FrameSink::close().
  virtual void close() {}
};

/// A message and the time of its sending.
struct ReceivedMessage {
  const std::byte* data = nullptr;  ///< Plain CDR with its encapsulation header, or ROS 1's encoding.
  std::size_t size = 0;
  std::shared_ptr<const void> owner;  ///< Keeps the bytes alive.
  std::int64_t sent_ns = 0;           ///< Time of sending, nanoseconds of the sender's system clock.
  std::size_t type = 0;               ///< Index of the message's type in the types of the receiver.
  bool ros1 = false;                  ///< The encoding is that of ROS 1, not CDR.
};

/// Receives the messages of one topic. Called by one thread.
class MessageReceiver {
 public:
  virtual ~MessageReceiver() = default;

  /// Waits at most `timeout` for the next message. Returns false if none came. If the caller is too slow,
  /// the receiver decides which messages are lost and reports losses by take_warnings().
  virtual bool next(ReceivedMessage& message, std::chrono::milliseconds timeout) = 0;

  /// Same as FrameSource::take_warnings().
  virtual std::vector<std::string> take_warnings() { return {}; }
};

/// Which messages of a topic a receiver gets.
enum class Delivery : std::uint8_t {
  newest,  ///< Those that arrive; a slow receiver loses old ones. Suits clouds.
  all,     ///< Lost ones are sent again, and up to 1000 wait for the receiver. Suits transforms.
  latched  ///< As `all`, and the last message from before the subscription. Suits fixed transforms.
};

/// A kind of transport. It is implemented by a module that middleware() loads.
class Middleware {
 public:
  virtual ~Middleware() = default;

  /// Subscribes to a topic ("/points") with messages of a type ("sensor_msgs/msg/PointCloud2"). If there are
  /// several types, the publishers of the topic decide: the receiver takes the first type until a publisher
  /// of another one appears while there is none of the type that it takes. Throws IoError if the network
  /// cannot be used. Throws std::invalid_argument if `types` is empty, for an invalid topic name or for an
  /// invalid value of an environment variable.
  virtual std::unique_ptr<MessageReceiver> receiver(const std::string& topic,
                                                    const std::vector<std::string>& types,
                                                    Delivery delivery = Delivery::newest) = 0;

  /// Creates a sender. `address` is for modules that need an address ("localhost:8765"). Throws as
  /// receiver().
  virtual std::unique_ptr<MessageSender> carrier(const std::string& address) = 0;
};

/// Returns the module with this name. The first call for a name loads the module, which is never unloaded.
///
/// - "dds": ROS 2 topics by Eclipse Cyclone DDS. docs/ros.md lists the environment variables that this module
///   uses.
/// - "ws": WebSockets for the viewers of Foxglove and for our page (docs/live.md). This module cannot receive
///   messages.
///
/// The module is the file pcl_bv/pcl_bv_NAME.so in the library folder next to the program or next to this
/// library. Throws IoError if the module is not installed or has another version.
Middleware& middleware(const std::string& name);

/// Returns a function that a module exports as `extern "C"`. Loads the module as middleware() does, and
/// throws as it, also if the module does not have the function.
void* module_function(const std::string& name, const char* function);

/// Functions that a module exports as `extern "C"`: in every module one that returns the module's version,
/// which must equal the version of the library, and in those of middleware() one that returns the object.
using ModuleVersion = const char* (*)();
using MiddlewareInstance = Middleware* (*)();
inline constexpr const char* kModuleVersion = "pcl_bv_module_version";
inline constexpr const char* kMiddlewareInstance = "pcl_bv_middleware";

}  // namespace detail
}  // namespace pcl_bv
