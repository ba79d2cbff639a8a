// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_scan.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "search.h"

namespace pcl_bv::detail {
namespace mcap {
namespace {

// Successive messages outside of chunks are one part, which ends when it exceeds this number of bytes.
constexpr std::uint64_t kLooseBytes = 1U << 20U;
// Bytes that are enough for a chunk's fields before its records, if the compression's name has at most 47
// bytes.
constexpr std::size_t kChunkStart = 96;

// Walks over the records of a file. Skips the content of chunks that the summary describes.
class Scan {
 public:
  Scan(const InputFile& file, Index& index, const Summary& summary)
      : file_(file), index_(index), summary_(summary) {
    for (const auto& [offset, part] : summary.chunks)
      remaining_chunks_.insert(offset);
  }

  UnindexedCounts run() {
    std::uint64_t previous = 0;  // position of the last record, whose length may be damaged
    for (std::uint64_t at = kMagic.size(); at + kRecordStart <= file_.size();) {
      if (const auto known = summary_.chunks.find(at); known != summary_.chunks.end()) {
        loose_ = false;
        index_.parts.push_back(known->second);
        remaining_chunks_.erase(at);
        at = std::max(end_of_chunk(*known), at + kRecordStart);  // must exceed the old `at`
        previous = at - 1;
        continue;
      }
      const std::vector<std::byte> start = bytes_at(file_, at, kRecordStart);
      Fields fields(start.data(), start.size());
      // Every opcode other than 0 can be a record. Records with reserved and private opcodes are skipped.
      const auto op = static_cast<Op>(fields.number<std::uint8_t>());
      const auto size = fields.number<std::uint64_t>();
      if (op == Op{0} || size > file_.size() - at - kRecordStart || (op == Op::chunk && !is_chunk_at(at))) {
        at = find_chunk(previous + 1, at);
        previous = at;
        continue;
      }
      previous = op == Op::chunk ? at + kRecordStart + size - 1 : at;
      visit_record(op, at, size);
      if (op == Op::data_end) break;
      at += kRecordStart + size;
    }
    add_remaining_chunks();
    return found_;
  }

 private:
  // Returns the end of the message indexes behind a chunk that the summary describes. If these indexes would
  // overlap the next chunk, returns the end of the chunk itself.
  std::uint64_t end_of_chunk(const std::pair<const std::uint64_t, Part>& chunk) const {
    const std::uint64_t end = chunk.first + chunk.second.bytes;
    const std::uint64_t index = summary_.index_bytes.at(chunk.first);
    const auto next = summary_.chunks.upper_bound(chunk.first);
    const std::uint64_t limit = next == summary_.chunks.end() ? file_.size() : next->first;
    return end <= limit && index <= limit - end ? end + index : end;
  }

  // Returns the position of the next chunk at or after `from`, or the file's end if there is none. The chunk
  // is in the summary, or is_chunk() finds it. Adds a warning for the skipped bytes.
  std::uint64_t find_chunk(std::uint64_t from, std::uint64_t damage) {
    const auto next = summary_.chunks.lower_bound(from);
    const std::uint64_t limit = next == summary_.chunks.end() ? file_.size() : next->first;
    const std::uint64_t found =
        find_in_file(file_, from, limit, kChunkStart, [&](const std::byte* bytes, std::size_t size, auto at) {
          return *bytes == std::byte{static_cast<std::uint8_t>(Op::chunk)} &&
                 is_chunk(bytes, size, file_.size() - at);
        });
    // If the length of a record is damaged, the next chunk may begin before the apparent end of the record.
    index_.warnings.add(found == file_.size()
                            ? "the file ends within a record, at byte " + std::to_string(damage)
                            : skipped_bytes(found > damage ? damage : from - 1, found));
    loose_ = false;
    return found;
  }

  bool is_chunk_at(std::uint64_t at) const {
    const std::vector<std::byte> bytes =
        bytes_at(file_, at, std::min<std::uint64_t>(kChunkStart, file_.size() - at));
    return is_chunk(bytes.data(), bytes.size(), file_.size() - at);
  }

  // Returns whether a chunk begins at `bytes`, judged by whether the lengths in the chunk's fields are
  // consistent. Accepts unknown compressions, so that a warning can name them.
  static bool is_chunk(const std::byte* bytes, std::size_t size, std::uint64_t left) {
    try {
      Fields fields(bytes, size);
      fields.number<std::uint8_t>();
      const auto length = fields.number<std::uint64_t>();
      if (length > left - std::min<std::uint64_t>(left, kRecordStart)) return false;
      fields.take(28);  // times, size, CRC
      const std::string_view name = fields.text();
      return length == 40 + name.size() + fields.number<std::uint64_t>();
    } catch (const IoError&) {
      return false;
    }
  }

  // Adds the chunks of the summary that the walk has not met.
  void add_remaining_chunks() {
    for (const std::uint64_t offset : remaining_chunks_)
      index_.parts.push_back(summary_.chunks.at(offset));
    std::stable_sort(index_.parts.begin(), index_.parts.end(),
                     [](const Part& a, const Part& b) { return a.offset < b.offset; });
  }

  void visit_record(Op op, std::uint64_t at, std::uint64_t size) {
    if (op == Op::message) return add_loose(at, size);
    loose_ = false;
    if (op == Op::chunk) return add_chunk(at, size);
    if (op != Op::schema && op != Op::channel) return;
    const std::vector<std::byte> record = bytes_at(file_, at + kRecordStart, size);
    warn_on_error(at, [&] { add_schema_or_channel({op, record.data(), record.size()}, index_); });
  }

  void add_loose(std::uint64_t at, std::uint64_t size) {
    if (size < kMessageStart) {
      index_.warnings.add("a message without a time, at byte " + std::to_string(at));
      return;
    }
    const std::vector<std::byte> start = bytes_at(file_, at + kRecordStart + 6, 8);
    const auto time = Fields(start.data(), start.size()).number<std::uint64_t>();
    if (!loose_ || index_.parts.back().bytes > kLooseBytes)
      index_.parts.push_back({at, 0, time, time, false});
    loose_ = true;
    ++found_.loose_messages;
    Part& part = index_.parts.back();
    part.bytes = at + kRecordStart + size - part.offset;
    part.first_time = std::min(part.first_time, time);
    part.last_time = std::max(part.last_time, time);
  }

  // Reads a chunk that is not in the summary. The chunk's schemas and channels may be nowhere else in the
  // file.
  void add_chunk(std::uint64_t at, std::uint64_t size) {
    ++found_.chunks;
    Part part{at, kRecordStart + size, 0, 0};
    warn_on_error(at, [&] {
      Fields records = load_part(file_, part, decompressor_, raw_, unpacked_);
      part.first_time = UINT64_MAX;
      const std::size_t part_index = index_.parts.size();
      index_.parts.push_back(part);
      while (records.left() > 0) {
        const Record record = take_record(records);
        add_schema_or_channel(record, index_);
        if (record.op == Op::message) note_message(record.fields(), index_.parts[part_index]);
      }
    });
  }

  static void note_message(Fields fields, Part& part) {
    part.channels.insert(fields.number<std::uint16_t>());
    fields.number<std::uint32_t>();  // sequence number
    const auto time = fields.number<std::uint64_t>();
    part.first_time = std::min(part.first_time, time);
    part.last_time = std::max(part.last_time, time);
  }

  template <class Do>
  void warn_on_error(std::uint64_t at, const Do& what) {
    try {
      what();
    } catch (const IoError& error) {
      index_.warnings.add("skipped the record at byte " + std::to_string(at) + ": " + error.what());
    }
  }

  const InputFile& file_;
  Index& index_;
  const Summary& summary_;
  std::set<std::uint64_t> remaining_chunks_;  // positions of the summary's chunks that the walk has not met
  UnindexedCounts found_;
  Decompressor decompressor_;
  std::vector<std::byte> raw_, unpacked_;
  bool loose_ = false;  // whether the last record was a message outside of chunks, which is in the last part
};

}  // namespace

std::vector<std::byte> bytes_at(const InputFile& file, std::uint64_t offset, std::uint64_t size) {
  std::vector<std::byte> bytes(size);
  file.read(offset, bytes.data(), bytes.size());
  return bytes;
}

void add_schema_or_channel(const Record& record, Index& index) {
  if (record.op == Op::schema) {
    Schema schema;
    take(record.fields(), schema);
    index.schemas[schema.id] = std::move(schema);
  } else if (record.op == Op::channel) {
    Channel channel;
    take(record.fields(), channel);
    index.channels[channel.id] = std::move(channel);
  }
}

UnindexedCounts scan(const InputFile& file, const Summary& summary, Index& index) {
  return Scan(file, index, summary).run();
}

}  // namespace mcap
}  // namespace pcl_bv::detail
