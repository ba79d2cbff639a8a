// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <limits>

#include "chunked_reader.h"
#include "formats.h"
#include "mcap_index.h"

namespace pcl_bv::detail {
namespace {

std::int64_t signed_time(std::uint64_t time) {
  constexpr auto max_time = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return static_cast<std::int64_t>(std::min(time, max_time));
}

class McapReader final : public ChunkedReader {
 public:
  explicit McapReader(const std::filesystem::path& path) : file_(path), index_(mcap::index_of(file_)) {
    std::uint64_t added = 0;
    add_warnings(index_.warnings, added);
    TopicList topics;
    for (const auto& [id, channel] : index_.channels)
      topic_of_[id] = topics.add(topic_of(channel));
    std::vector<Part> parts;
    for (const mcap::Part& part : index_.parts) {
      Part& to = parts.emplace_back();
      to = {part.offset, signed_time(part.first_time)};
      for (const std::uint16_t channel : part.channels) {
        if (const auto found = topic_of_.find(channel); found != topic_of_.end())
          to.topics.push_back(found->second);
      }
    }
    start(std::move(topics.all()), std::move(parts));
  }

 private:
  RecordedTopic topic_of(const mcap::Channel& channel) const {
    const auto schema = index_.schemas.find(channel.schema);
    const auto messages = index_.messages.find(channel.id);
    return {channel.topic, schema == index_.schemas.end() ? "" : ros2_type(schema->second.name),
            channel.encoding, messages == index_.messages.end() ? 0 : messages->second};
  }

  void load(std::size_t part, Buffers& buffers, std::vector<RecordedMessage>& messages) override {
    file_.require_unchanged();
    const auto unpack = [&](std::vector<std::byte>& to) {
      return mcap::load_part(file_, index_.parts[part], decompressor(), buffers.raw, to);
    };
    auto records =
        unpack_shared<mcap::Fields>(cache_, part_offset(part), buffers.shared, buffers.unpacked, unpack);
    while (records.left() > 0) {
      const mcap::Record record = mcap::take_record(records);
      if (record.op != mcap::Op::message) continue;
      mcap::Fields fields = record.fields();
      const auto channel = fields.number<std::uint16_t>();
      const auto topic = topic_of_.find(channel);
      fields.number<std::uint32_t>();  // sequence number
      RecordedMessage message;
      message.log_time_ns = signed_time(fields.number<std::uint64_t>());
      message.publish_time_ns = signed_time(fields.number<std::uint64_t>());
      if (topic == topic_of_.end() && unknown_.insert(channel).second)
        add_warning("messages of unknown channel " + std::to_string(channel) + " are skipped");
      if (topic == topic_of_.end() || !wanted(topic->second)) continue;
      message.topic = topic->second;
      message.data = fields.here();
      message.size = fields.left();
      messages.push_back(message);
    }
  }

  InputFile file_;
  std::shared_ptr<ChunkCache> cache_ = ChunkCache::of(file_);
  mcap::Index index_;
  std::map<std::uint16_t, std::size_t> topic_of_;  // index in the topics, by channel id
  std::set<std::uint16_t> unknown_;                // ids of channels that have messages but no channel record
};

}  // namespace

std::unique_ptr<RecordingReader> open_mcap(const std::filesystem::path& file) {
  return std::make_unique<McapReader>(file);
}

}  // namespace pcl_bv::detail
