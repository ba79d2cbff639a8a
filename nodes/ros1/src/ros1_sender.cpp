// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "ros1_sender.h"

#include <ros/init.h>

#include <algorithm>
#include <cstring>

#include "pcl_bv/messages/schema.h"

namespace pcl_bv {
namespace {

struct SerializedBytes {
  const std::vector<std::byte>& bytes;
};

}  // namespace
}  // namespace pcl_bv

namespace ros {
namespace message_traits {
template <>
struct IsMessage<pcl_bv::SerializedBytes> : TrueType {};
template <>
struct MD5Sum<pcl_bv::SerializedBytes> {
  static const char* value() { return "*"; }
  static const char* value(const pcl_bv::SerializedBytes&) { return value(); }
};
template <>
struct DataType<pcl_bv::SerializedBytes> {
  static const char* value() { return "*"; }
  static const char* value(const pcl_bv::SerializedBytes&) { return value(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<pcl_bv::SerializedBytes> {
  template <class Stream>
  static void write(Stream& stream, const pcl_bv::SerializedBytes& message) {
    const std::vector<std::byte>& bytes = message.bytes;
    if (!bytes.empty()) std::memcpy(stream.advance(serializedLength(message)), bytes.data(), bytes.size());
  }
  static std::uint32_t serializedLength(const pcl_bv::SerializedBytes& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};
}  // namespace serialization
}  // namespace ros

namespace pcl_bv {

std::size_t Ros1Sender::add_topic(const MessageTopic& topic) {
  const Ros1Type type = ros1_type_of(topic.type);
  const auto changed = [this](const ros::SingleSubscriberPublisher&) { on_change_(); };
  ros::AdvertiseOptions options(topic.name.substr(topic.name.find_first_not_of('/')),
                                static_cast<std::uint32_t>(topic.history), type.md5, type.name,
                                type.definition, changed, changed);
  options.latch = topic.latched;
  publishers_.push_back(node_.advertise(options));
  return publishers_.size() - 1;
}

void Ros1Sender::send(std::size_t topic, std::int64_t, const std::vector<std::byte>& message) {
  if (ros::ok()) publishers_.at(topic).publish(SerializedBytes{message});
}

void Ros1Sender::close() {
  for (ros::Publisher& publisher : publishers_)
    publisher.shutdown();
}

bool Ros1Sender::is_subscribed() const {
  return std::any_of(publishers_.begin(), publishers_.end(),
                     [](const ros::Publisher& publisher) { return publisher.getNumSubscribers() > 0; });
}

}  // namespace pcl_bv
