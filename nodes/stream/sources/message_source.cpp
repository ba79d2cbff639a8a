// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "message_source.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cloud_message.h"
#include "message_stamps.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/topics.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

class MessageSource final : public FrameSource {
 public:
  MessageSource(std::unique_ptr<MessageReceiver> receiver, const std::string& name,
                const ReplayOptions& options)
      : receiver_(std::move(receiver)),
        name_(name),
        class_field_(options.class_field),
        frame_id_(options.frame_id) {
    if (receiver_ == nullptr) throw std::invalid_argument("make_message_source: no receiver");
    if (!options.poses.empty()) poses_ = Poses(options.poses, std::nullopt);
  }

  Next next(Frame& frame, std::chrono::milliseconds timeout) override {
    ReceivedMessage message;
    if (!receiver_->next(message, timeout)) return Next::timeout;
    const auto came = std::chrono::steady_clock::now();
    frame = Frame();
    frame.file = name_;
    frame.taken = came;
    frame.header.seq = seq_++;
    frame.header.stamp_ns = frame.recorded_ns = message.sent_ns;
    try {
      const CloudType type = cloud_type_of(cloud_type_names().at(message.type)).value();
      read_cloud_message({message.data, message.size, message.owner, message.ros1, type}, class_field_,
                         frame);
    } catch (const std::exception& error) {
      throw FrameError(std::move(frame), reason_of(error));
    }
    frame.header.stamp_ns = stamps_.next(frame.header.stamp_ns, message.sent_ns);
    if (!frame_id_.empty()) frame.header.frame_id = frame_id_;
    frame.pose = poses_.at(0, frame.header.stamp_ns);
    frame.decode_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - came).count();
    return Next::frame;
  }

  std::vector<std::string> take_warnings() override {
    std::vector<std::string> all = receiver_->take_warnings();
    std::ranges::move(stamps_.take_warnings(), std::back_inserter(all));
    return all;
  }

 private:
  std::unique_ptr<MessageReceiver> receiver_;
  std::string name_, class_field_, frame_id_;
  Poses poses_;
  MessageStamps stamps_;
  std::uint64_t seq_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> make_message_source(std::unique_ptr<MessageReceiver> receiver,
                                                 const std::string& name, const ReplayOptions& options) {
  return std::make_unique<MessageSource>(std::move(receiver), name, options);
}

}  // namespace pcl_bv::detail
