// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "chunked_reader.h"

#include "formats.h"

#include <algorithm>
#include <numeric>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace {

// Chunks whose times overlap are in memory together. Real ones have some megabytes.
constexpr std::size_t kMaxLoadedBytes = std::size_t{4} << 30;

}  // namespace

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
  if (current_) spare_.push_back(std::move(current_));
  for (auto& loaded : loaded_)
    spare_.push_back(std::move(loaded));
  loaded_.clear();
  loaded_bytes_ = 0;
}

bool ChunkedReader::next(RecordedMessage& message) {
  put_back();
  while (next_part_ < order_.size()) {
    const std::int64_t begins = parts_[order_[next_part_]].first_time_ns;
    if (!loaded_.empty() && begins > loaded_.front()->time()) break;
    load_next();
  }
  if (loaded_.empty()) return false;
  std::pop_heap(loaded_.begin(), loaded_.end(), is_later);
  current_ = std::move(loaded_.back());
  loaded_.pop_back();
  message = current_->messages[current_->next++];
  return true;
}

bool ChunkedReader::is_later(const std::unique_ptr<LoadedPart>& a, const std::unique_ptr<LoadedPart>& b) {
  return a->time() != b->time() ? a->time() > b->time() : a->part > b->part;
}

// Puts the part of the previous message back, unless it has no further ones. The caller may use the message
// of the previous call until the next call of next().
void ChunkedReader::put_back() {
  if (!current_) return;
  if (current_->next < current_->messages.size()) return push(std::move(current_));
  loaded_bytes_ -= current_->buffers.bytes();
  spare_.push_back(std::move(current_));
}

void ChunkedReader::push(std::unique_ptr<LoadedPart> part) {
  loaded_.push_back(std::move(part));
  std::push_heap(loaded_.begin(), loaded_.end(), is_later);
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
  if (loaded_bytes_ + loaded->buffers.bytes() > kMaxLoadedBytes && !loaded_.empty()) {
    add_warning("skipped the chunk at byte " + std::to_string(part.offset) +
                ": chunks of the same time have more than 4 GiB together");
    loaded->messages.clear();
    loaded->buffers = {};
  }
  if (loaded->messages.empty()) return spare_.push_back(std::move(loaded));
  loaded_bytes_ += loaded->buffers.bytes();
  push(std::move(loaded));
}

std::size_t TopicList::add(const RecordedTopic& topic) {
  const auto [found, added] = numbers_.try_emplace({topic.name, topic.type, topic.encoding}, topics_.size());
  if (added) {
    topics_.push_back(topic);
  } else {
    topics_[found->second].messages += topic.messages;
  }
  return found->second;
}

std::string ros2_type(std::string_view type) {
  std::string name(type);
  const std::size_t slash = name.find('/');
  if (slash != std::string::npos && name.find('/', slash + 1) == std::string::npos)
    name.insert(slash, "/msg");
  return name;
}

}  // namespace pcl_bv::detail
