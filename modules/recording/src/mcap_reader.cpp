// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "formats.h"
#include "mcap_index.h"

namespace pcl_bv {
namespace {

std::int64_t signed_time(std::uint64_t time) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return static_cast<std::int64_t>(std::min(time, most));
}

// The selected messages of a part, in their order.
struct Loaded {
  struct Place {
    std::uint64_t time;
    const std::byte* message;
    std::size_t size;
  };
  std::size_t part = 0;
  std::vector<Place> places;
  std::size_t next = 0;
  mcap::PartBuffers buffers;

  std::uint64_t time() const { return places[next].time; }
};

class McapReader final : public RecordingReader {
 public:
  explicit McapReader(const std::filesystem::path& path) : file_(path), index_(mcap::index_of(file_)) {
    for (const std::string& line : index_.remarks)
      remark(line);
    for (const auto& [id, channel] : index_.channels)
      topic_of_[id] = add_topic(channel);
    for (std::size_t i = 0; i < index_.parts.size(); ++i)
      order_.push_back(i);
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return index_.parts[a].first_time < index_.parts[b].first_time;
    });
    std::vector<std::size_t> all(topics_.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = i;
    select(all);
  }

  const std::vector<RecordedTopic>& topics() const override { return topics_; }

  void select(const std::vector<std::size_t>& topics) override {
    wanted_.assign(topics_.size(), false);
    for (const std::size_t topic : topics)
      wanted_.at(topic) = true;
    next_part_ = 0;
    for (auto& loaded : loaded_)
      spare_.push_back(std::move(loaded));
    loaded_.clear();
  }

  bool next(RecordedMessage& message) override {
    release();
    while (next_part_ < order_.size() &&
           (loaded_.empty() || index_.parts[order_[next_part_]].first_time <= earliest()->time()))
      load(order_[next_part_++]);
    if (loaded_.empty()) return false;
    Loaded& from = *earliest();
    const Loaded::Place& place = from.places[from.next++];
    mcap::Fields fields(place.message, place.size);
    message.topic = topic_of_.at(fields.number<std::uint16_t>());
    fields.number<std::uint32_t>();  // its number in the channel
    message.log_time_ns = signed_time(fields.number<std::uint64_t>());
    message.publish_time_ns = signed_time(fields.number<std::uint64_t>());
    message.data = fields.here();
    message.size = fields.left();
    return true;
  }

 private:
  // Channels of the same name and type, of several senders, are one topic.
  std::size_t add_topic(const mcap::Channel& channel) {
    const auto schema = index_.schemas.find(channel.schema);
    RecordedTopic topic{channel.topic, schema == index_.schemas.end() ? "" : ros2_type(schema->second.name),
                        channel.encoding};
    const auto messages = index_.messages.find(channel.id);
    const std::uint64_t count = messages == index_.messages.end() ? 0 : messages->second;
    const auto same = [&](const RecordedTopic& other) {
      return other.name == topic.name && other.type == topic.type && other.encoding == topic.encoding;
    };
    auto found = std::find_if(topics_.begin(), topics_.end(), same);
    if (found == topics_.end()) found = topics_.insert(topics_.end(), topic);
    found->messages += count;
    return static_cast<std::size_t>(found - topics_.begin());
  }

  bool wants(std::uint16_t channel) const {
    const auto found = topic_of_.find(channel);
    return found != topic_of_.end() && wanted_[found->second];
  }

  // Of equal times that of the part which comes first in the file.
  Loaded* earliest() const {
    const auto before = [](const auto& a, const auto& b) {
      return a->time() != b->time() ? a->time() < b->time() : a->part < b->part;
    };
    return std::min_element(loaded_.begin(), loaded_.end(), before)->get();
  }

  // What next() gave is not looked at any more.
  void release() {
    for (auto loaded = loaded_.begin(); loaded != loaded_.end();) {
      if ((*loaded)->next < (*loaded)->places.size()) {
        ++loaded;
      } else {
        spare_.push_back(std::move(*loaded));
        loaded = loaded_.erase(loaded);
      }
    }
  }

  void load(std::size_t number) {
    const mcap::Part& part = index_.parts[number];
    const auto wanted = [this](std::uint16_t channel) { return wants(channel); };
    if (!part.channels.empty() && std::none_of(part.channels.begin(), part.channels.end(), wanted)) return;
    std::unique_ptr<Loaded> loaded = spare_.empty() ? std::make_unique<Loaded>() : std::move(spare_.back());
    if (!spare_.empty()) spare_.pop_back();
    loaded->part = number;
    loaded->next = 0;
    try {
      find_messages(part, *loaded);
    } catch (const IoError& error) {
      remark("passed over the chunk at byte " + std::to_string(part.offset) + ": " + error.what());
      loaded->places.clear();
    }
    (loaded->places.empty() ? spare_ : loaded_).push_back(std::move(loaded));
  }

  void find_messages(const mcap::Part& part, Loaded& loaded) {
    loaded.places.clear();
    mcap::Fields records = mcap::load_part(file_, part, loaded.buffers);
    while (records.left() > 0) {
      const mcap::Record record = mcap::take_record(records);
      if (record.op != mcap::Op::message) continue;
      mcap::Fields fields = record.fields();
      const auto channel = fields.number<std::uint16_t>();
      fields.number<std::uint32_t>();
      const auto time = fields.number<std::uint64_t>();
      fields.number<std::uint64_t>();
      if (wants(channel)) loaded.places.push_back({time, record.data, record.size});
    }
    std::stable_sort(loaded.places.begin(), loaded.places.end(),
                     [](const Loaded::Place& a, const Loaded::Place& b) { return a.time < b.time; });
  }

  InputFile file_;
  mcap::Index index_;
  std::vector<RecordedTopic> topics_;
  std::map<std::uint16_t, std::size_t> topic_of_;  // by channel
  std::vector<bool> wanted_;                       // by topic
  std::vector<std::size_t> order_;                 // of the parts, by their first times
  std::size_t next_part_ = 0;
  std::vector<std::unique_ptr<Loaded>> loaded_, spare_;
};

}  // namespace

std::unique_ptr<RecordingReader> open_mcap(const std::filesystem::path& file) {
  return std::make_unique<McapReader>(file);
}

}  // namespace pcl_bv
