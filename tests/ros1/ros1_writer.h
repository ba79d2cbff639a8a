// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Publishes messages that pcl_bv writes, so that tests need no further package of ROS.
#pragma once

#include <ros/ros.h>

#include <cstring>
#include <string>
#include <vector>

#include "background.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::test {

struct Written {
  std::vector<std::byte> bytes;
};

}  // namespace pcl_bv::test

namespace ros {
namespace message_traits {
template <>
struct IsMessage<pcl_bv::test::Written> : TrueType {};
template <>
struct MD5Sum<pcl_bv::test::Written> {
  static const char* value(const pcl_bv::test::Written&) { return "*"; }
};
template <>
struct DataType<pcl_bv::test::Written> {
  static const char* value(const pcl_bv::test::Written&) { return "*"; }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<pcl_bv::test::Written> {
  template <class Stream>
  static void write(Stream& stream, const pcl_bv::test::Written& message) {
    std::memcpy(stream.advance(serializedLength(message)), message.bytes.data(), message.bytes.size());
  }
  static std::uint32_t serializedLength(const pcl_bv::test::Written& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};
}  // namespace serialization
}  // namespace ros

namespace pcl_bv::test {

/// A publisher of a topic.
class Writer {
 public:
  Writer(ros::NodeHandle& node, const std::string& topic, const char* type, const char* md5,
         bool latch = false) {
    ros::AdvertiseOptions options(topic, 100, md5, type, "# written by pcl_bv");
    options.latch = latch;
    publisher_ = node.advertise(options);
  }
  template <class Message>
  void send(const Message& message) const {
    Written written;
    write_ros1(message, written.bytes);
    publisher_.publish(written);
  }
  bool heard() const {
    return wait_for([&] { return publisher_.getNumSubscribers() > 0; });
  }

 private:
  ros::Publisher publisher_;
};

/// A publisher of transforms, which are latched for "/tf_static".
inline Writer transforms(ros::NodeHandle& node, const std::string& topic) {
  return {node, topic, "tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec", topic == "/tf_static"};
}

}  // namespace pcl_bv::test
