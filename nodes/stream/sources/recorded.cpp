// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A source of the clouds in a recording.

#include <algorithm>
#include <iterator>

#include "cloud_message.h"
#include "message_stamps.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/topics.h"
#include "pcl_bv/recording/packet_reader.h"
#include "pcl_bv/recording/recording.h"
#include "recorded_clouds.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

std::unique_ptr<RecordingReader> open_checked(const std::string& name) {
  check_recording_content(name);
  return open_recording(name);
}

class Recorded final : public FrameSource {
 public:
  Recorded(const std::string& name, const ReplayOptions& options)
      : name_(name),
        options_(options),
        reader_(open_checked(name)),
        topic_(cloud_topic(*reader_, options.topic)) {
    reader_->select({topic_});
    if (!options_.poses.empty()) poses_ = Poses(options_.poses, count());
  }

  Next next(Frame& frame, std::chrono::milliseconds) override {
    const auto begin = std::chrono::steady_clock::now();
    RecordedMessage message;
    while (!reader_->next(message)) {
      if (++loop_ >= options_.loops || index_ == 0) return Next::end;
      reader_->select({topic_});
      index_ = 0;
    }
    frame = Frame();
    frame.file = name_;
    frame.header.seq = seq_++;
    frame.pass = loop_;
    frame.header.stamp_ns = frame.recorded_ns = message.log_time_ns;
    const std::size_t index = index_++;
    try {
      read(message, frame);
    } catch (const std::exception& error) {
      throw FrameError(std::move(frame), reason_of(error));
    }
    frame.pose = poses_.at(index, replay_stamp(options_, frame.header.stamp_ns, index));
    frame.decode_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return Next::frame;
  }

  std::vector<std::string> take_warnings() override {
    std::vector<std::string> all = take_new(reader_->warning_lines(), warnings_taken_);
    std::ranges::move(stamps_.take_warnings(), std::back_inserter(all));
    return all;
  }

 private:
  // Returns the number of clouds according to the index. Without an index, reads all messages to count the
  // clouds.
  std::size_t count() {
    std::size_t messages = reader_->topics()[topic_].messages;
    if (messages > 0) return messages;
    for (RecordedMessage message; reader_->next(message);)
      ++messages;
    reader_->select({topic_});
    return messages;
  }

  // Returns whether the first two clouds, or the only one, have the stamp 0: their driver wrote no stamps.
  // One of several is no proof, because a recording or a simulation may begin at 0. Reads the file anew, so
  // that the messages that follow are not lost.
  bool begins_without_stamps() const {
    const std::unique_ptr<RecordingReader> reader = open_checked(name_);
    reader->select({topic_});
    RecordedMessage message;
    for (int i = 0; i < 2 && reader->next(message); ++i)
      if (stamp_of(message) != 0) return false;
    return true;
  }

  // Returns the stamp in a message; 0 if the message cannot be read.
  std::int64_t stamp_of(const RecordedMessage& message) const {
    Frame frame;
    try {
      parse(message, frame);
    } catch (const std::exception&) {
      return 0;
    }
    return frame.header.stamp_ns;
  }

  void parse(const RecordedMessage& message, Frame& frame) const {
    const auto bytes = std::make_shared<std::vector<std::byte>>(message.data, message.data + message.size);
    const RecordedTopic& topic = reader_->topics()[topic_];
    read_cloud_message(
        {bytes->data(), bytes->size(), bytes, topic.encoding != "cdr", cloud_type_of(topic.type).value()},
        options_.class_field, frame);
  }

  void read(const RecordedMessage& message, Frame& frame) {
    parse(message, frame);
    if (options_.own_stamps) {
      if (!std::exchange(checked_stamps_, true) && frame.header.stamp_ns == 0 && begins_without_stamps())
        stamps_.expect_none();
      frame.header.stamp_ns = stamps_.next(frame.header.stamp_ns, message.log_time_ns);
    }
    frame.header.stamp_ns = replay_stamp(options_, frame.header.stamp_ns, frame.header.seq);
    if (!options_.frame_id.empty()) frame.header.frame_id = options_.frame_id;
  }

  std::string name_;
  ReplayOptions options_;
  std::unique_ptr<RecordingReader> reader_;
  std::size_t topic_;
  Poses poses_;
  MessageStamps stamps_;
  bool checked_stamps_ = false;  // whether the first readable cloud has come
  std::uint64_t seq_ = 0;
  std::size_t index_ = 0, loop_ = 0, warnings_taken_ = 0;
};

std::unique_ptr<FrameSource> open_recorded(const std::string& name, const ReplayOptions& options) {
  try {
    return std::make_unique<Recorded>(name, options);
  } catch (const IoError& error) {
    throw IoError(name + ": " + error.what());
  }
}

// Returns whether the name is that of a recording. The file may be missing or damaged.
bool is_named_recording(const std::filesystem::path& file) {
  std::error_code unknown;
  return has_recording_extension(file) && !std::filesystem::is_directory(file, unknown);
}

}  // namespace

std::vector<SourceKind> recording_kinds() {
  return {{"packets of a Velodyne, Hesai, Livox or Ouster (.pcap, .pcapng)", FrameTimes::messages,
           [](const std::string& name) { return is_capture(name); }, open_packets},
          {"a recording (.mcap, .bag, .db3 or its folder)", FrameTimes::messages,
           [](const std::string& name) { return is_recording(name) || is_named_recording(name); },
           open_recorded}};
}

}  // namespace pcl_bv::detail
