// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// As much of rclcpp's names as a component uses that listens to one topic and answers on another: Debian has no rclcpp.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rclcpp {

struct NodeOptions {
  std::map<std::string, std::string> parameters;
};

struct SensorDataQoS {
  SensorDataQoS& keep_last(std::size_t) { return *this; }
};

template <class Message>
struct Publisher {
  using SharedPtr = std::shared_ptr<Publisher>;
  void publish(std::unique_ptr<Message> message) { published.push_back(std::move(message)); }
  std::vector<std::unique_ptr<Message>> published;
};

template <class Message>
struct Subscription {
  using SharedPtr = std::shared_ptr<Subscription>;
  std::function<void(std::unique_ptr<Message>)> receive;
};

class Node {
 public:
  Node(std::string name, NodeOptions options) : name_(std::move(name)), options_(std::move(options)) {}
  virtual ~Node() = default;

  std::string declare_parameter(const std::string& name, const std::string& value) const {
    const auto found = options_.parameters.find(name);
    return found == options_.parameters.end() ? value : found->second;
  }
  template <class Message>
  typename Publisher<Message>::SharedPtr create_publisher(const std::string& topic, std::size_t) {
    const auto made = std::make_shared<Publisher<Message>>();
    topics[topic] = made;
    return made;
  }
  template <class Message, class Qos, class Callback>
  typename Subscription<Message>::SharedPtr create_subscription(const std::string& topic, const Qos&, Callback callback) {
    const auto made = std::make_shared<Subscription<Message>>();
    made->receive = std::move(callback);
    topics[topic] = made;
    return made;
  }
  Node& get_logger() { return *this; }

  std::map<std::string, std::shared_ptr<void>> topics;
  std::vector<std::string> warnings;

 private:
  std::string name_;
  NodeOptions options_;
};

}  // namespace rclcpp

#define RCLCPP_WARN(logger, format, ...) (logger).warnings.emplace_back(__VA_ARGS__)
