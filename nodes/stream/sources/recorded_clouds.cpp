// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "recorded_clouds.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "cloud_message.h"
#include "pcl_bv/io/posix_file.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/nodes/topics.h"
#include "pcl_bv/recording/packet_reader.h"
#include "pcl_bv/recording/recording.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

bool has_clouds(const RecordedTopic& topic) {
  return cloud_type_of(topic.type) && (topic.encoding == "cdr" || topic.encoding == "ros1");
}

std::string clouds_of(const std::vector<RecordedTopic>& topics) {
  std::vector<std::string> names;
  for (const RecordedTopic& topic : topics)
    if (has_clouds(topic)) names.push_back(topic.name);
  return name_list(names);
}

// Returns a list of the topics with their types, such as "/scan (sensor_msgs/msg/LaserScan)". Users
// need the type to convert the messages.
std::string topics_with_types(const std::vector<RecordedTopic>& topics) {
  std::vector<std::string> names;
  for (const RecordedTopic& topic : topics) {
    const bool usual = topic.encoding == "cdr" || topic.encoding == "ros1" || topic.encoding.empty();
    names.push_back(topic.name + " (" + (topic.type.empty() ? "of no type" : topic.type) +
                    (usual ? "" : ", " + topic.encoding) + ')');
  }
  return names.empty() ? "none" : name_list(names);
}

}  // namespace

std::size_t cloud_topic(const RecordingReader& reader, const std::string& name) {
  const std::vector<RecordedTopic>& topics = reader.topics();
  const std::vector<std::string>& damage = reader.warning_lines();
  if (topics.empty() && !damage.empty()) throw IoError("no topic can be read: " + damage.front());
  const std::string clouds = clouds_of(topics);
  const std::string others = topics.empty()   ? "the recording has no topics"
                             : clouds.empty() ? "there are " + topics_with_types(topics)
                                              : "those with clouds: " + clouds;
  const auto number = [&](auto found) { return static_cast<std::size_t>(found - topics.begin()); };
  if (!name.empty()) {
    const auto is_named = [&](const RecordedTopic& topic) { return topic.name == name; };
    const auto found = std::find_if(topics.begin(), topics.end(), is_named);
    if (found == topics.end()) throw std::invalid_argument(message_line("no topic " + name + "; " + others));
    // Several senders may use one name for messages of several types.
    const auto cloud = std::find_if(topics.begin(), topics.end(), [&](const RecordedTopic& topic) {
      return is_named(topic) && has_clouds(topic);
    });
    if (cloud != topics.end()) return number(cloud);
    throw std::invalid_argument(message_line("topic " + name + " is of " +
                                             (found->type.empty() ? "no type" : found->type) + " (" +
                                             found->encoding + "), not of clouds; " + others));
  }
  const auto count = std::count_if(topics.begin(), topics.end(), has_clouds);
  if (count > 1)
    throw std::invalid_argument(
        message_line("several topics have clouds: " + clouds + "; choose one with --topic"));
  if (count == 0) throw IoError(message_line("no topic with clouds; topics: " + topics_with_types(topics)));
  return number(std::find_if(topics.begin(), topics.end(), has_clouds));
}

std::unique_ptr<RecordingReader> open_named_recording(const std::string& recording) {
  try {
    return open_recording(recording);
  } catch (const IoError& error) {
    throw IoError(recording + ": " + error.what());
  }
}

std::vector<std::string> recorded_cloud_topics(const std::string& recording) {
  std::vector<std::string> names;
  if (is_capture(recording)) {
    names = sensors_in_capture(recording);
    if (names.size() < 2) names.clear();
    return names;
  }
  const auto reader = open_named_recording(recording);
  std::set<std::string_view> known;
  for (const RecordedTopic& topic : reader->topics())
    if (has_clouds(topic) && known.insert(topic.name).second) names.push_back(topic.name);
  return names;
}

std::vector<std::string> take_new(const std::vector<std::string>& warnings, std::size_t& taken) {
  std::vector<std::string> added(
      warnings.begin() + static_cast<std::ptrdiff_t>(std::min(taken, warnings.size())), warnings.end());
  taken = std::max(taken, warnings.size());
  return added;
}

bool has_recorded_clouds(const std::filesystem::path& file) {
  return is_recording(file) || is_capture(file);
}

void check_recording_content(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!has_recording_extension(file) || std::filesystem::is_directory(file, unknown) ||
      has_recorded_clouds(file))
    return;
  static_cast<void>(InputFile(file));  // throws the better error for a missing or empty file
  throw IoError(
      "is no recording that can be read: it does not begin as MCAP, a ROS 1 bag 2.0, SQLite or pcap does");
}

// Maximum number of skipped clouds that are stored. If several threads load clouds of one file, some clouds
// are requested shortly after later clouds of the file. Without stored clouds, each such request would read
// the file again.
constexpr std::size_t kMaxSkipped = 16;

struct RecordedClouds::State {
  std::unique_ptr<RecordingReader> reader;
  std::unique_ptr<PacketReader> packets;  // used instead of `reader` for a packet capture
  std::size_t topic = 0;
  std::size_t next = 0;                                      // number of the next cloud in the file
  std::map<std::size_t, std::function<RawCloud()>> skipped;  // by number; returns the cloud or throws
  std::string note;                                          // note of the last cloud that was read
  std::map<std::size_t, std::string> notes;  // by number; notes that differ from the previous note
  std::vector<std::string> taken;            // warnings that take_warnings() has returned
  mutable std::mutex mutex;

  void rewind() {
    if (packets) {
      packets->rewind();
    } else {
      reader->select({topic});
    }
    next = 0;
    note.clear();
  }

  // Reads the bytes of the next cloud. Returns false at the end.
  bool take() { return packets ? packets->next(sweep) : reader->next(message); }

  RawCloud cloud() const {
    if (packets) return raw_cloud_of(sweep);
    const RecordedTopic& from = reader->topics()[topic];
    return raw_cloud_in(
        {message.data, message.size, nullptr, from.encoding != "cdr", cloud_type_of(from.type).value()});
  }

  // Converts the cloud that take() has read. Counts the cloud, also if the conversion throws. Stores the
  // cloud's note if it differs from the note of the cloud converted before.
  RawCloud noted_cloud() {
    const std::size_t number = next++;
    RawCloud made = cloud();
    if (made.note != note) notes[number] = made.note;
    note = made.note;
    return made;
  }

  // Stores the cloud that take() has read.
  void skip() {
    std::function<RawCloud()>& stored = skipped[next];
    try {
      const auto made = std::make_shared<RawCloud>(noted_cloud());
      stored = [made] { return std::move(*made); };
    } catch (const std::exception&) {
      stored = [error = std::current_exception()]() -> RawCloud { std::rethrow_exception(error); };
    }
    if (skipped.size() > kMaxSkipped) skipped.erase(skipped.begin());
  }

  std::vector<std::string> warnings() const {
    return packets ? packets->warning_lines() : reader->warning_lines();
  }

  RecordedMessage message;
  SensorSweep sweep;
};

RecordedClouds::RecordedClouds(const std::filesystem::path& file, const std::string& topic)
    : state_(std::make_unique<State>()) {
  if (is_capture(file)) {
    state_->packets = std::make_unique<PacketReader>(file, topic);
    return;
  }
  state_->reader = open_recording(file);
  state_->topic = cloud_topic(*state_->reader, topic);
  state_->rewind();
}
RecordedClouds::~RecordedClouds() = default;

std::size_t RecordedClouds::count() {
  const std::lock_guard lock(state_->mutex);
  std::size_t clouds = state_->packets ? 0 : state_->reader->topics()[state_->topic].messages;
  if (clouds > 0) return clouds;
  state_->rewind();
  while (state_->take())
    ++clouds;
  state_->rewind();
  return clouds;
}

RawCloud RecordedClouds::load(std::size_t number) {
  const std::lock_guard lock(state_->mutex);
  State& state = *state_;
  if (const auto stored = state.skipped.extract(number)) return stored.mapped()();
  if (number < state.next) state.rewind();
  for (;;) {
    if (!state.take())
      throw IoError("no such cloud: " + std::to_string(state.next) +
                    " clouds of the recording can be read, and numbers count these");
    if (state.next == number) return state.noted_cloud();
    if (number - state.next > kMaxSkipped) {
      ++state.next;
    } else {
      state.skip();
    }
  }
}

std::string RecordedClouds::new_note(std::size_t number) const {
  const std::lock_guard lock(state_->mutex);
  const auto found = state_->notes.find(number);
  return found == state_->notes.end() ? std::string() : found->second;
}

std::vector<std::string> RecordedClouds::warnings() const {
  const std::lock_guard lock(state_->mutex);
  return state_->warnings();
}

// Compares warnings by their texts, because the same damage is found again when its part of the file is read
// again.
std::vector<std::string> RecordedClouds::take_warnings() {
  const std::lock_guard lock(state_->mutex);
  std::vector<std::string> fresh;
  for (std::string& warning : state_->warnings()) {
    if (std::find(state_->taken.begin(), state_->taken.end(), warning) != state_->taken.end()) continue;
    state_->taken.push_back(warning);
    fresh.push_back(std::move(warning));
  }
  return fresh;
}

}  // namespace pcl_bv::detail
