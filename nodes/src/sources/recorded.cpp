// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clouds of a recording.

#include <cmath>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/recorded_clouds.h"
#include "pcl_bv/recording/recording.h"
#include "sources.h"

namespace pcl_bv {
namespace {

// What a frame's points look at.
struct Held {
  std::vector<std::byte> bytes;
  RawCloud copy;
};

class Recorded final : public FrameSource {
 public:
  Recorded(const std::string& name, const ReplayOptions& options)
      : name_(name),
        options_(options),
        reader_(open_recording(name)),
        topic_(cloud_topic(reader_->topics(), options.topic)) {
    reader_->select({topic_});
    if (!options_.poses.empty()) poses_ = Poses(options_.poses, count());
  }

  Next next(Frame& frame, std::chrono::milliseconds) override {
    const auto begin = std::chrono::steady_clock::now();
    RecordedMessage message;
    while (!reader_->next(message)) {
      if (++loop_ >= options_.loops || place_ == 0) return Next::end;
      reader_->select({topic_});
      place_ = 0;
    }
    frame = Frame();
    frame.file = name_;
    frame.header.seq = seq_++;
    frame.header.stamp_ns = message.log_time_ns;
    const std::size_t place = place_++;
    try {
      read(message, frame);
    } catch (const std::exception& error) {
      throw FrameError(std::move(frame), error.what());
    }
    frame.pose = poses_.at(place, frame.header.stamp_ns);
    frame.decode_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return Next::frame;
  }

  std::vector<std::string> take_remarks() override {
    const std::vector<std::string>& all = reader_->remarks();
    std::vector<std::string> fresh(all.begin() + static_cast<std::ptrdiff_t>(remarks_), all.end());
    remarks_ = all.size();
    return fresh;
  }

 private:
  // An index knows; else all messages are passed over.
  std::size_t count() {
    std::size_t messages = reader_->topics()[topic_].messages;
    if (messages > 0) return messages;
    for (RecordedMessage message; reader_->next(message);)
      ++messages;
    reader_->select({topic_});
    return messages;
  }

  void read(const RecordedMessage& message, Frame& frame) {
    const auto held = std::make_shared<Held>();
    held->bytes.assign(message.data, message.data + message.size);
    msg::PointCloud2 cloud;
    if (reader_->topics()[topic_].encoding == "cdr") {
      read_cdr(held->bytes.data(), held->bytes.size(), cloud);
    } else {
      read_ros1(held->bytes.data(), held->bytes.size(), cloud);
    }
    set_header(cloud.header, frame);
    const std::optional<PointView> in_place = points_in_place(cloud);
    if (!in_place || !options_.class_field.empty()) held->copy = raw_cloud_of(cloud);
    frame.points = in_place ? *in_place : held->copy.xyz();
    if (!options_.class_field.empty())
      frame.classes =
          std::make_shared<std::vector<std::int64_t>>(integers_of(held->copy, options_.class_field));
    frame.owner = held;
  }

  // Without a stamp of the sensor: when it was recorded.
  void set_header(const msg::Header& header, Frame& frame) const {
    const std::int64_t stamp = msg::nanoseconds_of(header.stamp);
    if (stamp != 0) frame.header.stamp_ns = stamp;
    if (!options_.from_name)
      frame.header.stamp_ns = std::llround(1e9 * static_cast<double>(frame.header.seq) / options_.rate_hz);
    frame.header.frame_id = options_.frame_id.empty() ? header.frame_id : options_.frame_id;
  }

  std::string name_;
  ReplayOptions options_;
  std::unique_ptr<RecordingReader> reader_;
  std::size_t topic_;
  Poses poses_;
  std::uint64_t seq_ = 0;
  std::size_t place_ = 0, loop_ = 0, remarks_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_recorded(const std::string& name, const ReplayOptions& options) {
  try {
    return std::make_unique<Recorded>(name, options);
  } catch (const IoError& error) {
    throw IoError(name + ": " + error.what());
  }
}

}  // namespace pcl_bv
