// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "transform_feed.h"

#include <chrono>
#include <utility>

#include "pcl_bv/messages/serialize.h"
#include "stream/middleware.h"

namespace pcl_bv::detail {
namespace {

class LiveTransforms final : public TransformFeed {
 public:
  LiveTransforms()
      : changing_(middleware("dds").receiver("/tf", {msg::TFMessage::ros_type}, Delivery::all)),
        fixed_(middleware("dds").receiver("/tf_static", {msg::TFMessage::ros_type}, Delivery::latched)) {}

  void read(std::int64_t /*recorded_ns*/, Transforms& to) override {
    read_topic(*fixed_, true, to);
    read_topic(*changing_, false, to);
  }

  std::vector<std::string> take_warnings() override {
    std::vector<std::string> all = std::exchange(warnings_, {});
    for (MessageReceiver* const receiver : {fixed_.get(), changing_.get()})
      for (std::string& line : receiver->take_warnings())
        all.push_back(std::move(line));
    return all;
  }

 private:
  void read_topic(MessageReceiver& receiver, bool fixed, Transforms& to) {
    constexpr int max_messages = 1000;  // of one call, so that a fast sender cannot hold up the clouds
    ReceivedMessage message;
    for (int i = 0; i < max_messages && receiver.next(message, std::chrono::milliseconds(0)); ++i) {
      std::string warning;
      try {
        warning = add_transforms({message.data, message.size, false, false, fixed}, to);
      } catch (const MessageError& error) {
        warning = error.what();
      }
      if (warning.empty() || std::exchange(warned_, true)) continue;
      warnings_.push_back((fixed ? "/tf_static: " : "/tf: ") + warning);
    }
  }

  std::unique_ptr<MessageReceiver> changing_, fixed_;
  std::vector<std::string> warnings_;
  bool warned_ = false;
};

}  // namespace

std::unique_ptr<TransformFeed> live_transforms() {
  return std::make_unique<LiveTransforms>();
}

}  // namespace pcl_bv::detail
