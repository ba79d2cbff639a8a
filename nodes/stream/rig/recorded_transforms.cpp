// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/messages/odometry.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/recording/recording.h"
#include "stream/sources/sources.h"
#include "transform_feed.h"

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kReadAhead = 500'000'000;  // nanoseconds
// Times of damaged recordings may be anything. Sums and differences of times up to this do not overflow.
constexpr std::int64_t kMaxTime = 4'000'000'000'000'000'000;  // nanoseconds, the year 2096

bool is_encoded(const RecordedTopic& topic) {
  return topic.encoding == "cdr" || topic.encoding == "ros1";
}
bool has_odometry(const RecordedTopic& topic) {
  return is_encoded(topic) && topic.type == msg::Odometry::ros_type;
}
// ROS 1's older type has the same layout.
bool has_transforms(const RecordedTopic& topic) {
  return is_encoded(topic) && (topic.type == msg::TFMessage::ros_type || topic.type == "tf/msg/tfMessage");
}

// Returns the last part of a topic's name: "tf" of "/robot1/tf".
std::string last_part(const RecordedTopic& topic) {
  return topic.name.substr(topic.name.rfind('/') + 1);
}
bool is_fixed(const RecordedTopic& topic) {
  return has_transforms(topic) && last_part(topic) == "tf_static";
}
bool is_changing(const RecordedTopic& topic) {
  return has_transforms(topic) && last_part(topic) == "tf";
}

// Returns the name without its last part and the first slash: "robot1/" of "/robot1/tf", "" of "/tf".
std::string namespace_of(const RecordedTopic& topic) {
  const std::size_t begin = topic.name.starts_with('/') ? 1 : 0;
  return topic.name.substr(begin, topic.name.rfind('/') + 1 - begin);
}

template <typename Is>
std::vector<std::size_t> topics_that(const std::vector<RecordedTopic>& topics, const Is& is) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < topics.size(); ++i)
    if (is(topics[i])) found.push_back(i);
  return found;
}

// The topics of one robot. Robots in one recording have the same frames, so their poses must not be mixed.
struct TransformTopics {
  std::vector<std::size_t> fixed, changing;
  std::string warning{};
};

// Returns the topics /tf_static and /tf or, without these, those of the first namespace that has them.
TransformTopics transform_topics_of(const std::vector<RecordedTopic>& topics) {
  std::set<std::string> namespaces;
  for (const std::size_t i : topics_that(topics, has_transforms))
    if (is_fixed(topics[i]) || is_changing(topics[i])) namespaces.insert(namespace_of(topics[i]));
  if (namespaces.empty()) return {};
  const std::string used = *namespaces.begin();  // "" is first
  const auto in_use = [&](const RecordedTopic& topic) { return namespace_of(topic) == used; };
  TransformTopics found{
      topics_that(topics, [&](const RecordedTopic& topic) { return is_fixed(topic) && in_use(topic); }),
      topics_that(topics, [&](const RecordedTopic& topic) { return is_changing(topic) && in_use(topic); })};
  namespaces.erase(used);
  if (!used.empty() && !namespaces.empty())
    found.warning = "transforms of /" + used + "tf are used, those of /" + *namespaces.begin() + "tf are not";
  return found;
}

class RecordedTransforms final : public TransformFeed {
 public:
  RecordedTransforms(std::unique_ptr<RecordingReader> reader, TransformTopics topics)
      : reader_(std::move(reader)), fixed_(std::move(topics.fixed)), changing_(std::move(topics.changing)) {
    if (!topics.warning.empty()) warnings_.push_back(message_line(topics.warning));
  }

  // Fixed transforms may be recorded late, for example if the recording was started late. They hold for the
  // whole recording, so they are read first.
  void read(std::int64_t recorded_ns, Transforms& to) override {
    if (!std::exchange(begun_, true)) {
      read_fixed(to);
      reader_->select(changing_);
    }
    if (changing_.empty()) return;
    recorded_ns = std::clamp(recorded_ns, -kMaxTime, kMaxTime);
    if (latest_ns_ && recorded_ns < *latest_ns_ - kRestart) begin_again();
    latest_ns_ = std::max(latest_ns_.value_or(recorded_ns), recorded_ns);
    while (read_next() && next_->log_time_ns <= recorded_ns + kReadAhead)
      add(*std::exchange(next_, std::nullopt), false, to);
  }

  std::vector<std::string> take_warnings() override { return std::exchange(warnings_, {}); }

 private:
  void begin_again() {
    reader_->select(changing_);
    at_end_ = false;
    latest_ns_.reset();
    next_.reset();
  }

  // Reads the next message if none is kept. Returns false at the end.
  bool read_next() {
    if (RecordedMessage message; !next_ && !at_end_) {
      at_end_ = !reader_->next(message);
      if (!at_end_) next_ = message;
    }
    return next_.has_value();
  }

  void read_fixed(Transforms& to) {
    if (fixed_.empty()) return;
    std::uint64_t left = 0;
    for (const std::size_t topic : fixed_) {
      const std::uint64_t messages = reader_->topics()[topic].messages;
      if (messages == 0) left = std::numeric_limits<std::uint64_t>::max();  // the number is not known
      if (left < std::numeric_limits<std::uint64_t>::max()) left += messages;
    }
    reader_->select(fixed_);
    // The file need not be read to its end after the last of these messages.
    for (RecordedMessage message; left > 0 && reader_->next(message); --left)
      add(message, true, to);
  }

  void add(const RecordedMessage& message, bool fixed, Transforms& to) {
    const RecordedTopic& topic = reader_->topics()[message.topic];
    std::string warning;
    try {
      warning = add_transforms(
          {message.data, message.size, topic.encoding == "ros1", has_odometry(topic), fixed}, to);
    } catch (const MessageError& error) {
      warning = error.what();
    }
    if (!warning.empty() && !std::exchange(warned_, true))
      warnings_.push_back(message_line(topic.name + ": " + warning));
  }

  std::unique_ptr<RecordingReader> reader_;
  std::vector<std::size_t> fixed_, changing_;
  // Kept until its time is requested: after a pause of 20 s it would displace the poses before the pause.
  std::optional<RecordedMessage> next_;
  std::optional<std::int64_t> latest_ns_;  // latest requested time
  bool begun_ = false, at_end_ = false, warned_ = false;
  std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> recorded_odometry_topics(const std::string& recording) {
  std::vector<std::string> names;
  if (!is_recording(recording)) return names;
  const auto reader = open_named_recording(recording);
  for (const std::size_t topic : topics_that(reader->topics(), has_odometry))
    names.push_back(reader->topics()[topic].name);
  return names;
}

std::unique_ptr<TransformFeed> recorded_transforms(const std::string& recording,
                                                   const std::string& odometry) {
  if (!is_recording(recording)) return nullptr;  // a capture of packets
  std::unique_ptr<RecordingReader> reader = open_named_recording(recording);
  const std::vector<RecordedTopic>& topics = reader->topics();
  TransformTopics used = transform_topics_of(topics);
  // Two topics of odometry are two estimates of the same pose, which must not be mixed.
  const std::vector<std::size_t> estimates = topics_that(topics, [&](const RecordedTopic& topic) {
    return has_odometry(topic) && (odometry.empty() || topic.name == odometry);
  });
  if (!estimates.empty() && (used.changing.empty() || !odometry.empty()))
    used.changing.push_back(estimates.front());
  if (used.fixed.empty() && used.changing.empty()) return nullptr;
  return std::make_unique<RecordedTransforms>(std::move(reader), std::move(used));
}

}  // namespace pcl_bv::detail
