// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "live_topics.h"

#include <ros/names.h>
#include <ros/subscriber.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv {
namespace {

// A message of any type.
struct RawMessage {
  std::vector<std::byte> bytes;
};

// Returns the name in ROS 2 of a type of ROS 1: "tf2_msgs/msg/TFMessage" of "tf2_msgs/TFMessage".
std::string ros2_type(const std::string& type) {
  if (type == "tf/tfMessage") return "tf2_msgs/msg/TFMessage";  // the older name of the same layout
  const std::size_t slash = type.find('/');
  return slash == std::string::npos ? type : type.substr(0, slash) + "/msg" + type.substr(slash);
}

}  // namespace
}  // namespace pcl_bv

// "*" matches the publishers of any type.
namespace ros {
namespace message_traits {
template <>
struct IsMessage<pcl_bv::RawMessage> : TrueType {};
template <>
struct MD5Sum<pcl_bv::RawMessage> {
  static const char* value() { return "*"; }
  static const char* value(const pcl_bv::RawMessage&) { return value(); }
};
template <>
struct DataType<pcl_bv::RawMessage> {
  static const char* value() { return "*"; }
  static const char* value(const pcl_bv::RawMessage&) { return value(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<pcl_bv::RawMessage> {
  template <class Stream>
  static void read(Stream& stream, pcl_bv::RawMessage& message) {
    const auto* const first = reinterpret_cast<const std::byte*>(stream.getData());
    message.bytes.assign(first, first + stream.getLength());
    stream.advance(stream.getLength());
  }
};
}  // namespace serialization
}  // namespace ros

namespace pcl_bv {

// The messages of a topic that wait for their receiver. A full inbox drops its oldest message.
class LiveTopics::Inbox {
 public:
  Inbox(std::string topic, std::vector<std::string> types, Delivery delivery)
      : topic_(std::move(topic)), types_(std::move(types)), delivery_(delivery) {}
  ~Inbox() { unsubscribe(); }
  Inbox(const Inbox&) = delete;
  Inbox& operator=(const Inbox&) = delete;

  bool has_clouds() const { return delivery_ == Delivery::newest; }

  void subscribe(ros::NodeHandle& node) {
    const boost::function<void(const ros::MessageEvent<RawMessage const>&)> add =
        [this](const ros::MessageEvent<RawMessage const>& event) { receive(event); };
    subscriber_ = node.subscribe<RawMessage>(topic_, static_cast<std::uint32_t>(capacity()), add,
                                             ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  }

  // Returns after a running callback.
  void unsubscribe() { subscriber_.shutdown(); }

  bool next(ReceivedMessage& message, std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, timeout, [&] { return !messages_.empty(); })) return false;
    message = std::move(messages_.front());
    messages_.pop_front();
    return true;
  }

  std::vector<std::string> take_warnings() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warnings_, {});
  }

 private:
  std::size_t capacity() const { return has_clouds() ? 2 : 1000; }

  void receive(const ros::MessageEvent<RawMessage const>& event) {
    const ros::M_string& header = event.getConnectionHeader();
    const auto name = header.find("type");
    const std::string type = name == header.end() ? types_.front() : ros2_type(name->second);
    const auto known = std::find(types_.begin(), types_.end(), type);
    const std::lock_guard lock(mutex_);
    if (known == types_.end()) {
      constexpr std::size_t most = 20;
      if (others_.size() < most && others_.insert(type).second)
        warnings_.push_back(message_line("published as " + type + ": messages ignored, expected " +
                                         types_.front() +
                                         (others_.size() < most ? "" : "; further types are not named")));
      return;
    }
    ReceivedMessage message;
    const auto& raw = event.getConstMessage();
    message.data = raw->bytes.data();
    message.size = raw->bytes.size();
    message.owner = std::shared_ptr<const void>(raw.get(), [raw](const void*) {});
    message.sent_ns = static_cast<std::int64_t>(event.getReceiptTime().toNSec());
    message.type = static_cast<std::size_t>(known - types_.begin());
    message.ros1 = true;
    if (messages_.size() == capacity()) messages_.pop_front();
    messages_.push_back(std::move(message));
    arrived_.notify_one();
  }

  const std::string topic_;
  const std::vector<std::string> types_;
  const Delivery delivery_;
  ros::Subscriber subscriber_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<ReceivedMessage> messages_;
  std::vector<std::string> warnings_;
  std::set<std::string> others_;  // types that a warning has named
};

class LiveTopics::Receiver final : public MessageReceiver {
 public:
  explicit Receiver(std::shared_ptr<Inbox> inbox) : inbox_(std::move(inbox)) {}
  bool next(ReceivedMessage& message, std::chrono::milliseconds timeout) override {
    return inbox_->next(message, timeout);
  }
  std::vector<std::string> take_warnings() override { return inbox_->take_warnings(); }

 private:
  std::shared_ptr<Inbox> inbox_;
};

std::unique_ptr<MessageReceiver> LiveTopics::receiver(const std::string& topic,
                                                      const std::vector<std::string>& types,
                                                      Delivery delivery) {
  if (types.empty()) throw std::invalid_argument("a receiver needs a type of messages");
  std::string problem;
  if (!ros::names::validate(topic, problem))
    throw std::invalid_argument(message_line(topic + ": " + problem));
  inboxes_.push_back(std::make_shared<Inbox>(topic, types, delivery));
  if (!inboxes_.back()->has_clouds()) inboxes_.back()->subscribe(node_);
  return std::make_unique<Receiver>(inboxes_.back());
}

std::unique_ptr<MessageSender> LiveTopics::carrier(const std::string& /*address*/) {
  throw std::logic_error("LiveTopics: cannot send messages");
}

void LiveTopics::subscribe_to_clouds(bool wanted) {
  for (const std::shared_ptr<Inbox>& inbox : inboxes_) {
    if (!inbox->has_clouds()) continue;
    if (wanted) {
      inbox->subscribe(node_);
    } else {
      inbox->unsubscribe();
    }
  }
}

}  // namespace pcl_bv
