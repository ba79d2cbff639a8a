// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/recording/mcap_writer.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "codecs.h"
#include "mcap_records.h"
#include "pcl_bv/io/crc32.h"
#include "pcl_bv/io/growing_file.h"
#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {

using mcap::Op;
using mcap::Writer;

namespace {

using Buffer = std::vector<std::byte>;

struct OpenChannel {
  mcap::Schema schema;
  mcap::Channel channel;
  std::uint32_t sequence = 0;
  std::vector<mcap::MessageTime> in_chunk;
};

std::uint64_t time_of(std::int64_t nanoseconds) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(nanoseconds, 0));
}

}  // namespace

class McapWriter::State {
 public:
  State(const std::filesystem::path& file, const Options& options) : file_(file), options_(options) {
    Writer writer(start_);
    writer.bytes(mcap::kMagic.data(), mcap::kMagic.size());
    writer.begin(Op::header);
    writer.text("ros2");
    writer.text("pcl_bv");
    writer.end();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  bool has_begun() const { return start_.empty(); }

  std::size_t add_topic(const WrittenTopic& topic) {
    if (channels_.size() == std::numeric_limits<std::uint16_t>::max())
      throw std::length_error("a recording of more than 65535 topics");
    const auto id = static_cast<std::uint16_t>(channels_.size());
    const auto schema_id = static_cast<std::uint16_t>(id + 1);  // 0 means no schema
    OpenChannel& open = channels_.emplace_back();
    open.schema = {schema_id, topic.type, "ros2msg", topic.definition};
    open.channel = {id, schema_id, topic.name, "cdr", topic.metadata};
    open.channel.metadata.try_emplace("offered_qos_profiles");
    Buffer records;  // written outside of chunks, because a damaged chunk would lose them
    Writer writer(has_begun() ? records : start_);
    put(writer, open.schema);
    put(writer, open.channel);
    if (has_begun()) append(records);
    return id;
  }

  void write(std::size_t topic, std::uint64_t log_time, std::uint64_t publish_time, const std::byte* data,
             std::size_t size) {
    OpenChannel& channel = channels_.at(topic);
    begin();
    const bool first = chunk_.empty();
    first_time_ = first ? log_time : std::min(first_time_, log_time);
    last_time_ = first ? log_time : std::max(last_time_, log_time);
    channel.in_chunk.push_back({log_time, chunk_.size()});
    Writer writer(chunk_);
    writer.begin(Op::message);
    writer.number(static_cast<std::uint16_t>(topic));
    writer.number(channel.sequence++);
    writer.number(log_time);
    writer.number(publish_time);
    writer.bytes(data, size);
    writer.end();
    if (chunk_.size() >= options_.chunk_bytes) end_chunk();
  }

  void attach(const std::string& name, const std::string& media_type, const std::string& content,
              std::uint64_t log_time) {
    begin();
    Buffer record;
    Writer writer(record);
    writer.begin(Op::attachment);
    writer.number(log_time);
    writer.number(log_time);  // as creation time, which is unknown
    writer.text(name);
    writer.text(media_type);
    writer.number(static_cast<std::uint64_t>(content.size()));
    writer.bytes(content.data(), content.size());
    writer.number(crc32_of(record.data() + mcap::kRecordStart, record.size() - mcap::kRecordStart));
    writer.end();
    mcap::AttachmentIndex index{at_, record.size(), log_time, log_time, content.size(), name, media_type};
    append(record);
    attachments_.push_back(std::move(index));
  }

  void close() {
    if (closed_) return;
    begin();
    end_chunk();
    closed_ = true;
    Buffer end;
    Writer writer(end);
    writer.begin(Op::data_end);
    writer.number(std::uint32_t{0});  // no CRC of the data section, because each chunk has its own
    writer.end();
    append(end);
    write_summary();
    if (const int error = file_.close()) throw IoError(system_reason(error));
  }

 private:
  // Writes the header and the first topics.
  void begin() {
    if (has_begun()) return;
    append(start_);
    start_.clear();
  }

  // Appends all bytes or none, so that later records, such as the summary, stay readable.
  void append(const Buffer& bytes) {
    if (const int error = file_.append({reinterpret_cast<const char*>(bytes.data()), bytes.size()}))
      throw IoError(system_reason(error));
    at_ += bytes.size();
  }

  // Writes the chunk with its message indexes in one step.
  void end_chunk() {
    if (chunk_.empty()) return;
    compressor_.compress(options_.compression, chunk_.data(), chunk_.size(), compressed_);
    out_.clear();
    Writer writer(out_);
    writer.begin(Op::chunk);
    writer.number(first_time_);
    writer.number(last_time_);
    writer.number(static_cast<std::uint64_t>(chunk_.size()));
    writer.number(crc32_of(chunk_.data(), chunk_.size()));
    writer.text(name_of(options_.compression));
    writer.number(static_cast<std::uint64_t>(compressed_.size()));
    writer.bytes(compressed_.data(), compressed_.size());
    writer.end();
    mcap::ChunkIndex index{
        first_time_,        last_time_,   at_, out_.size(), {}, 0, std::string(name_of(options_.compression)),
        compressed_.size(), chunk_.size()};
    mcap::Statistics all = statistics_;
    put_message_indexes(writer, index, all);
    chunk_.clear();  // before append(), so that the next chunk begins empty even if writing fails
    append(out_);
    all.first_time = chunks_.empty() ? first_time_ : std::min(all.first_time, first_time_);
    all.last_time = std::max(all.last_time, last_time_);
    statistics_ = std::move(all);
    chunks_.push_back(std::move(index));
  }

  void put_message_indexes(Writer& writer, mcap::ChunkIndex& index, mcap::Statistics& all) {
    for (OpenChannel& open : channels_) {
      if (open.in_chunk.empty()) continue;
      index.indexes[open.channel.id] = at_ + out_.size();
      put(writer, open.channel.id, open.in_chunk);
      all.messages += open.in_chunk.size();
      all.channel_messages[open.channel.id] += open.in_chunk.size();
      open.in_chunk.clear();
    }
    index.index_bytes = out_.size() - index.bytes;
  }

  // Writes the summary: one group of records for each kind of record, then the position of each group.
  void write_summary() {
    Buffer summary, offsets;
    Writer writer(summary), offset_writer(offsets);
    const auto group = [&](Op op, const auto& put_all) {
      const std::size_t first = summary.size();
      put_all();
      if (summary.size() == first) return;
      offset_writer.begin(Op::summary_offset);
      offset_writer.number(static_cast<std::uint8_t>(op));
      offset_writer.number(at_ + first);
      offset_writer.number(static_cast<std::uint64_t>(summary.size() - first));
      offset_writer.end();
    };
    const auto each = [&](const auto& list) {
      for (const auto& record : list)
        put(writer, record);
    };
    statistics_.schemas = static_cast<std::uint16_t>(channels_.size());
    statistics_.channels = static_cast<std::uint32_t>(channels_.size());
    statistics_.attachments = static_cast<std::uint32_t>(attachments_.size());
    statistics_.chunks = static_cast<std::uint32_t>(chunks_.size());
    group(Op::schema, [&] {
      std::for_each(channels_.begin(), channels_.end(),
                    [&](const OpenChannel& open) { put(writer, open.schema); });
    });
    group(Op::channel, [&] {
      std::for_each(channels_.begin(), channels_.end(),
                    [&](const OpenChannel& open) { put(writer, open.channel); });
    });
    group(Op::statistics, [&] { put(writer, statistics_); });
    group(Op::chunk_index, [&] { each(chunks_); });
    group(Op::attachment_index, [&] { each(attachments_); });
    const std::uint64_t start = at_, offset_start = at_ + summary.size();
    writer.bytes(offsets.data(), offsets.size());
    put_footer(summary, writer, start, offset_start);
    append(summary);
  }

  // Appends the footer and the magic number. The footer's CRC covers the summary and the footer up to the
  // CRC.
  static void put_footer(const Buffer& summary, Writer& writer, std::uint64_t start,
                         std::uint64_t offset_start) {
    writer.begin(Op::footer);
    writer.number(start);
    writer.number(offset_start);
    writer.number(std::uint32_t{0});
    writer.end();
    writer.set(summary.size() - 4, crc32_of(summary.data(), summary.size() - 4));
    writer.bytes(mcap::kMagic.data(), mcap::kMagic.size());
  }

  GrowingFile file_;
  Options options_;
  Buffer start_;  // header and first topics, until they are written
  std::uint64_t at_ = 0;
  std::vector<OpenChannel> channels_;
  std::vector<mcap::ChunkIndex> chunks_;
  std::vector<mcap::AttachmentIndex> attachments_;
  mcap::Statistics statistics_;
  Compressor compressor_;
  Buffer chunk_, compressed_, out_;
  std::uint64_t first_time_ = 0, last_time_ = 0;  // times of the current chunk
  bool closed_ = false;
};

McapWriter::McapWriter(const std::filesystem::path& file) : McapWriter(file, Options()) {}
McapWriter::McapWriter(const std::filesystem::path& file, const Options& options)
    : state_(std::make_unique<State>(file, options)) {}

McapWriter::~McapWriter() {
  try {
    if (state_->has_begun()) state_->close();
  } catch (const std::exception&) {  // a destructor cannot report errors
  }
}

std::size_t McapWriter::add_topic(const WrittenTopic& topic) {
  return state_->add_topic(topic);
}

void McapWriter::write(std::size_t topic, std::int64_t log_time_ns, std::int64_t publish_time_ns,
                       const std::byte* data, std::size_t size) {
  state_->write(topic, time_of(log_time_ns), time_of(publish_time_ns), data, size);
}

void McapWriter::attach(const std::string& name, const std::string& media_type, const std::string& content,
                        std::int64_t log_time_ns) {
  state_->attach(name, media_type, content, time_of(log_time_ns));
}

void McapWriter::close() {
  state_->close();
}

}  // namespace pcl_bv::detail
