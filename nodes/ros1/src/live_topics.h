// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Receives the messages of ROS 1's topics as bytes, so that the code for recordings and DDS reads them.
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "stream/middleware.h"

namespace pcl_bv {
using namespace detail;

/// The topics of a ROS 1 node. Its member functions are called by one thread; the callbacks of `node` may run
/// in another one.
class LiveTopics final : public Middleware {
 public:
  explicit LiveTopics(const ros::NodeHandle& node) : node_(node) {}

  /// Subscribes to a topic; to one with Delivery::newest only after subscribe_to_clouds(). Types have the
  /// names of ROS 2. Messages of other types are ignored with a warning. Throws std::invalid_argument if
  /// `types` is empty and for an invalid topic name. The receiver may outlive this object.
  std::unique_ptr<MessageReceiver> receiver(const std::string& topic, const std::vector<std::string>& types,
                                            Delivery delivery) override;

  /// Throws std::logic_error: the node publishes messages itself.
  std::unique_ptr<MessageSender> carrier(const std::string& address) override;

  /// Subscribes to the topics with Delivery::newest, or ends these subscriptions.
  void subscribe_to_clouds(bool wanted);

 private:
  class Inbox;
  class Receiver;

  ros::NodeHandle node_;
  std::vector<std::shared_ptr<Inbox>> inboxes_;
};

}  // namespace pcl_bv
