// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/recorded_clouds.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/messages/cloud.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/recording/recording.h"

namespace pcl_bv {
namespace {

bool has_clouds(const RecordedTopic& topic) {
  return topic.type == msg::PointCloud2::ros_type && (topic.encoding == "cdr" || topic.encoding == "ros1");
}

std::string list_of(const std::vector<RecordedTopic>& topics, bool (*which)(const RecordedTopic&)) {
  std::string list;
  for (const RecordedTopic& topic : topics) {
    if (which(topic)) list += (list.empty() ? "" : ", ") + topic.name;
  }
  return list.empty() ? "none" : list;
}

}  // namespace

std::size_t cloud_topic(const std::vector<RecordedTopic>& topics, const std::string& name) {
  const std::string clouds = list_of(topics, has_clouds);
  const auto number = [&](auto found) { return static_cast<std::size_t>(found - topics.begin()); };
  if (!name.empty()) {
    const auto found = std::find_if(topics.begin(), topics.end(),
                                    [&](const RecordedTopic& topic) { return topic.name == name; });
    if (found == topics.end())
      throw std::invalid_argument("no topic " + name + "; those with clouds: " + clouds);
    if (!has_clouds(*found))
      throw std::invalid_argument("topic " + name + " is of " + found->type + " (" + found->encoding +
                                  "), not of clouds; those with clouds: " + clouds);
    return number(found);
  }
  const auto count = std::count_if(topics.begin(), topics.end(), has_clouds);
  if (count > 1)
    throw std::invalid_argument("several topics have clouds: " + clouds + "; say which with --topic");
  if (count == 0)
    throw IoError("no topic of " + std::string(msg::PointCloud2::ros_type) +
                  "; topics: " + list_of(topics, [](const RecordedTopic&) { return true; }));
  return number(std::find_if(topics.begin(), topics.end(), has_clouds));
}

struct RecordedClouds::State {
  std::unique_ptr<RecordingReader> reader;
  std::size_t topic = 0;
  std::size_t next = 0;  // number of the message that comes next
  mutable std::mutex mutex;

  void rewind() {
    reader->select({topic});
    next = 0;
  }
};

RecordedClouds::RecordedClouds(const std::filesystem::path& file, const std::string& topic)
    : state_(std::make_unique<State>()) {
  state_->reader = open_recording(file);
  state_->topic = cloud_topic(state_->reader->topics(), topic);
  state_->rewind();
}
RecordedClouds::~RecordedClouds() = default;

std::size_t RecordedClouds::count() {
  const std::lock_guard lock(state_->mutex);
  std::size_t messages = state_->reader->topics()[state_->topic].messages;
  if (messages > 0) return messages;
  state_->rewind();
  for (RecordedMessage message; state_->reader->next(message);)
    ++messages;
  state_->rewind();
  return messages;
}

RawCloud RecordedClouds::load(std::size_t number) {
  const std::lock_guard lock(state_->mutex);
  if (number < state_->next) state_->rewind();
  RecordedMessage message;
  for (; state_->next <= number; ++state_->next) {
    if (!state_->reader->next(message)) throw IoError("the recording ends before this cloud");
  }
  msg::PointCloud2 cloud;
  if (state_->reader->topics()[state_->topic].encoding == "cdr") {
    read_cdr(message.data, message.size, cloud);
  } else {
    read_ros1(message.data, message.size, cloud);
  }
  return raw_cloud_of(cloud);
}

std::vector<std::string> RecordedClouds::remarks() const {
  const std::lock_guard lock(state_->mutex);
  return state_->reader->remarks();
}

}  // namespace pcl_bv
