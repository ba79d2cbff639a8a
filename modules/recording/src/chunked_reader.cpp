// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "chunked_reader.h"

#include "formats.h"

#include <algorithm>
#include <numeric>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {

void ChunkedReader::start(std::vector<RecordedTopic> topics, std::vector<Part> parts) {
  topics_ = std::move(topics);
  parts_ = std::move(parts);
  order_.resize(parts_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    return parts_[a].first_time_ns < parts_[b].first_time_ns;
  });
  wanted_.assign(topics_.size(), true);
}

void ChunkedReader::select(const std::vector<std::size_t>& topics) {
  std::vector<bool> wanted(topics_.size(), false);
  for (const std::size_t topic : topics)
    wanted.at(topic) = true;
  wanted_ = std::move(wanted);
  next_part_ = 0;
  for (auto& loaded : loaded_)
    spare_.push_back(std::move(loaded));
  loaded_.clear();
}

bool ChunkedReader::next(RecordedMessage& message) {
  release();
  while (next_part_ < order_.size()) {
    const std::int64_t begins = parts_[order_[next_part_]].first_time_ns;
    if (!loaded_.empty() && begins > earliest()->messages[earliest()->next].log_time_ns) break;
    load_next();
  }
  if (loaded_.empty()) return false;
  LoadedPart& from = *earliest();
  message = from.messages[from.next++];
  return true;
}

// Returns the loaded part with the earliest next message. If times are equal, returns the first part in the
// file.
ChunkedReader::LoadedPart* ChunkedReader::earliest() const {
  const auto before = [](const auto& a, const auto& b) {
    const std::int64_t at = a->messages[a->next].log_time_ns, bt = b->messages[b->next].log_time_ns;
    return at != bt ? at < bt : a->part < b->part;
  };
  return std::min_element(loaded_.begin(), loaded_.end(), before)->get();
}

// Releases the parts without further messages. next() calls release() first, because the caller may use the
// message of the previous call until then.
void ChunkedReader::release() {
  for (auto loaded = loaded_.begin(); loaded != loaded_.end();) {
    if ((*loaded)->next < (*loaded)->messages.size()) {
      ++loaded;
    } else {
      spare_.push_back(std::move(*loaded));
      loaded = loaded_.erase(loaded);
    }
  }
}

void ChunkedReader::load_next() {
  const std::size_t number = order_[next_part_++];
  const Part& part = parts_[number];
  const auto is_wanted = [this](std::size_t topic) { return wanted_[topic]; };
  if (!part.topics.empty() && std::none_of(part.topics.begin(), part.topics.end(), is_wanted)) return;
  std::unique_ptr<LoadedPart> loaded;
  if (spare_.empty()) {
    loaded = std::make_unique<LoadedPart>();
  } else {
    loaded = std::move(spare_.back());
    spare_.pop_back();
  }
  loaded->part = number;
  loaded->next = 0;
  loaded->messages.clear();
  try {
    load(number, loaded->buffers, loaded->messages);
  } catch (const IoError& error) {
    const bool some = !loaded->messages.empty();  // the messages before the damage are intact
    add_warning(std::string("skipped the ") + (some ? "rest of the " : "") + "chunk at byte " +
                std::to_string(part.offset) + ": " + error.what());
  }
  std::stable_sort(
      loaded->messages.begin(), loaded->messages.end(),
      [](const RecordedMessage& a, const RecordedMessage& b) { return a.log_time_ns < b.log_time_ns; });
  (loaded->messages.empty() ? spare_ : loaded_).push_back(std::move(loaded));
}

std::size_t add_topic(std::vector<RecordedTopic>& topics, const RecordedTopic& topic) {
  auto found = std::find_if(topics.begin(), topics.end(), [&](const RecordedTopic& other) {
    return other.name == topic.name && other.type == topic.type && other.encoding == topic.encoding;
  });
  if (found == topics.end()) {
    topics.push_back(topic);
    return topics.size() - 1;
  }
  found->messages += topic.messages;
  return static_cast<std::size_t>(found - topics.begin());
}

std::string ros2_type(std::string_view type) {
  std::string name(type);
  const std::size_t slash = name.find('/');
  if (slash != std::string::npos && name.find('/', slash + 1) == std::string::npos)
    name.insert(slash, "/msg");
  return name;
}

}  // namespace pcl_bv::detail
