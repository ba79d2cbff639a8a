// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "transform_feed.h"

#include <chrono>
#include <utility>

#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/messages/odometry.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::detail {
namespace {

class LiveTransforms final : public TransformFeed {
 public:
  LiveTransforms(Middleware& middleware, const std::string& odometry) {
    add_topic(middleware, "/tf_static", Content::fixed);
    if (!odometry.empty()) add_topic(middleware, odometry, Content::odometry);
    add_topic(middleware, "/tf", Content::changing);
  }

  void read(std::int64_t /*recorded_ns*/, Transforms& to) override {
    for (Topic& topic : topics_)
      read_topic(topic, to);
  }

  std::vector<std::string> take_warnings() override {
    std::vector<std::string> all = std::exchange(warnings_, {});
    for (const Topic& topic : topics_)
      for (const std::string& line : topic.receiver->take_warnings())
        all.push_back(std::string(topic.name).append(": ").append(line));
    return all;
  }

 private:
  enum class Content : std::uint8_t { fixed, changing, odometry };
  struct Topic {
    std::string name;
    Content content;
    std::unique_ptr<MessageReceiver> receiver;
    bool warned = false;
  };

  void add_topic(Middleware& middleware, const std::string& name, Content content) {
    const char* const type =
        content == Content::odometry ? msg::Odometry::ros_type : msg::TFMessage::ros_type;
    const Delivery delivery = content == Content::fixed ? Delivery::latched : Delivery::all;
    topics_.push_back({name, content, middleware.receiver(name, {type}, delivery)});
  }

  void read_topic(Topic& topic, Transforms& to) {
    constexpr int max_messages = 1000;  // of one call, so that a fast sender cannot hold up the clouds
    ReceivedMessage message;
    for (int i = 0; i < max_messages && topic.receiver->next(message, std::chrono::milliseconds(0)); ++i) {
      std::string warning;
      try {
        warning = add_transforms({message.data, message.size, message.ros1,
                                  topic.content == Content::odometry, topic.content == Content::fixed},
                                 to);
      } catch (const MessageError& error) {
        warning = error.what();
      }
      if (warning.empty() || std::exchange(topic.warned, true)) continue;
      warnings_.push_back(message_line(topic.name + ": " + warning));
    }
  }

  std::vector<Topic> topics_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<TransformFeed> live_transforms(Middleware& middleware, const std::string& odometry) {
  return std::make_unique<LiveTransforms>(middleware, odometry);
}

}  // namespace pcl_bv::detail
