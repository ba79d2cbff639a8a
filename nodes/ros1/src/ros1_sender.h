// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Publishes the messages of adapters, whose types need no packages of ROS 1.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "stream/middleware.h"

namespace pcl_bv {
using namespace detail;

/// Publishes serialised messages to topics of a ROS 1 node. After ros::shutdown(), send() does nothing.
class Ros1Sender final : public MessageSender {
 public:
  /// `on_change` is called, in threads of roscpp, when a topic gets or loses a subscriber.
  Ros1Sender(const ros::NodeHandle& node, std::function<void()> on_change)
      : node_(node), on_change_(std::move(on_change)) {}

  /// The name of a topic is relative to the node's namespace, also with a leading '/'. The type has its name
  /// of ROS 2. Throws std::invalid_argument for types that ROS 1 does not have.
  std::size_t add_topic(const MessageTopic& topic) override;
  bool has_subscribers(std::size_t topic) const override {
    return publishers_.at(topic).getNumSubscribers() > 0;
  }
  bool takes_ros1() const override { return true; }
  void send(std::size_t topic, std::int64_t stamp_ns, const std::vector<std::byte>& message) override;
  /// Ends the publishers. `on_change` is not called afterwards.
  void close() override;

  /// Returns whether any topic has a subscriber.
  bool is_subscribed() const;

 private:
  ros::NodeHandle node_;
  std::function<void()> on_change_;
  std::vector<ros::Publisher> publishers_;
};

}  // namespace pcl_bv
