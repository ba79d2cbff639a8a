// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_index.h"

#include <algorithm>
#include <optional>

namespace pcl_bv {
namespace mcap {
namespace {

// Messages outside of chunks are taken together up to this.
constexpr std::uint64_t kLooseBytes = 1U << 20U;

std::vector<std::byte> bytes_at(const InputFile& file, std::uint64_t offset, std::uint64_t size) {
  std::vector<std::byte> bytes(size);
  file.read(offset, bytes.data(), bytes.size());
  return bytes;
}

// Schemas and channels, wherever they are.
void note(const Record& record, Index& index) {
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

void note_chunk(const Record& record, std::uint64_t end, Index& index) {
  ChunkIndex chunk;
  take(record.fields(), chunk);
  if (chunk.offset > end || chunk.bytes > end - chunk.offset)
    throw IoError("a chunk lies outside of the file");
  Part& part = index.parts.emplace_back();
  part = {chunk.offset, chunk.bytes, chunk.first_time, chunk.last_time};
  for (const auto& [channel, offset] : chunk.indexes)
    part.channels.insert(channel);
}

// The records of the summary. Throws IoError if it is not whole.
std::vector<std::byte> read_summary(const InputFile& file) {
  const std::uint64_t size = file.size();
  if (size < kMagic.size() + kFileEnd) throw IoError("it is cut");
  const std::vector<std::byte> end = bytes_at(file, size - kFileEnd, kFileEnd);
  if (std::memcmp(end.data() + kFooterBytes, kMagic.data(), kMagic.size()) != 0) throw IoError("it is cut");
  Fields fields(end.data(), kFooterBytes);
  const Record footer = take_record(fields);
  if (footer.op != Op::footer) throw IoError("it has no footer");
  Fields values = footer.fields();
  const auto start = values.number<std::uint64_t>();
  values.number<std::uint64_t>();  // where the summary's offsets are
  const auto crc = values.number<std::uint32_t>();
  if (start == 0) return {};
  if (start < kMagic.size() || start > size - kFileEnd) throw IoError("its summary lies outside");
  std::vector<std::byte> summary = bytes_at(file, start, size - start);
  if (crc != 0 && crc32_of(summary.data(), summary.size() - kMagic.size() - 4) != crc)
    throw IoError("its summary is damaged");
  summary.resize(summary.size() - kFileEnd);
  return summary;
}

// Nothing if it does not say where all messages are.
std::optional<Index> by_summary(const InputFile& file) {
  const std::vector<std::byte> summary = read_summary(file);
  Index index;
  std::optional<Statistics> statistics;
  for (Fields records(summary.data(), summary.size()); records.left() > 0;) {
    const Record record = take_record(records);
    note(record, index);
    if (record.op == Op::chunk_index) note_chunk(record, file.size(), index);
    if (record.op == Op::statistics) take(record.fields(), statistics.emplace());
  }
  const bool all = statistics && (statistics->messages == 0 || statistics->chunks == index.parts.size());
  if (!all || (index.parts.empty() && statistics->messages > 0) || index.channels.empty())
    return std::nullopt;
  index.messages = statistics->channel_messages;
  std::sort(index.parts.begin(), index.parts.end(),
            [](const Part& a, const Part& b) { return a.offset < b.offset; });
  return index;
}

// Walks over the records of a file.
class Scan {
 public:
  explicit Scan(const InputFile& file) : file_(file) {}

  Index all() {
    std::uint64_t at = kMagic.size();
    while (at + kRecordStart <= file_.size()) {
      const std::vector<std::byte> start = bytes_at(file_, at, kRecordStart);
      Fields fields(start.data(), start.size());
      const auto op = static_cast<Op>(fields.number<std::uint8_t>());
      const auto size = fields.number<std::uint64_t>();
      if (size > file_.size() - at - kRecordStart) {
        index_.remarks.push_back("the file ends within a record, at byte " + std::to_string(at));
        break;
      }
      look(op, at, size);
      if (op == Op::data_end) break;
      at += kRecordStart + size;
    }
    return std::move(index_);
  }

 private:
  void look(Op op, std::uint64_t at, std::uint64_t size) {
    if (op == Op::message) return add_loose(at, size);
    loose_ = false;
    if (op == Op::chunk) return add_chunk(at, size);
    if (op != Op::schema && op != Op::channel) return;
    const std::vector<std::byte> record = bytes_at(file_, at + kRecordStart, size);
    attempt(at, [&] { note({op, record.data(), record.size()}, index_); });
  }

  void add_loose(std::uint64_t at, std::uint64_t size) {
    if (size < kMessageStart) {
      index_.remarks.push_back("a message without a time, at byte " + std::to_string(at));
      return;
    }
    const std::vector<std::byte> start = bytes_at(file_, at + kRecordStart + 6, 8);
    const auto time = Fields(start.data(), start.size()).number<std::uint64_t>();
    if (!loose_ || index_.parts.back().bytes > kLooseBytes)
      index_.parts.push_back({at, 0, time, time, false});
    loose_ = true;
    Part& part = index_.parts.back();
    part.bytes = at + kRecordStart + size - part.offset;
    part.first_time = std::min(part.first_time, time);
    part.last_time = std::max(part.last_time, time);
  }

  // Channels may be nowhere else than inside.
  void add_chunk(std::uint64_t at, std::uint64_t size) {
    Part part{at, kRecordStart + size, 0, 0};
    attempt(at, [&] {
      const std::vector<std::byte> times =
          bytes_at(file_, at + kRecordStart, std::min<std::uint64_t>(size, 16));
      Fields fields(times.data(), times.size());
      part.first_time = fields.number<std::uint64_t>();
      part.last_time = fields.number<std::uint64_t>();
      Fields records = load_part(file_, part, decompressor_, raw_, unpacked_);
      while (records.left() > 0) {
        const Record record = take_record(records);
        note(record, index_);
        if (record.op == Op::message) part.channels.insert(record.fields().number<std::uint16_t>());
      }
      index_.parts.push_back(part);
    });
  }

  template <class Do>
  void attempt(std::uint64_t at, const Do& what) {
    try {
      what();
    } catch (const IoError& error) {
      index_.remarks.push_back("passed over what is at byte " + std::to_string(at) + ": " + error.what());
    }
  }

  const InputFile& file_;
  Index index_;
  Decompressor decompressor_;
  std::vector<std::byte> raw_, unpacked_;
  bool loose_ = false;  // whether the last part is of messages that this one follows
};

}  // namespace

Fields load_part(const InputFile& file, const Part& part, Decompressor& decompressor,
                 std::vector<std::byte>& raw, std::vector<std::byte>& unpacked) {
  raw.resize(part.bytes);
  file.read(part.offset, raw.data(), raw.size());
  Fields all(raw.data(), raw.size());
  if (!part.is_chunk) return all;
  const Record record = take_record(all);
  if (record.op != Op::chunk) throw IoError("there is no chunk");
  Fields fields = record.fields();
  fields.take(16);  // its times
  const auto length = fields.number<std::uint64_t>();
  const auto crc = fields.number<std::uint32_t>();
  const std::string_view name = fields.text();
  const auto size = fields.number<std::uint64_t>();
  const std::byte* data = fields.take(size);
  const auto* const known = std::find_if(std::begin(kCompressions), std::end(kCompressions),
                                         [&](Compression c) { return name_of(c) == name; });
  if (known == std::end(kCompressions)) throw IoError("its compression is " + in_quotes(name));
  if (*known != Compression::none) {
    decompressor.decompress(*known, data, size, length, unpacked);
    data = unpacked.data();
  } else if (size != length) {
    throw IoError("it has " + std::to_string(size) + " bytes, not " + std::to_string(length));
  }
  if (crc != 0 && crc32_of(data, length) != crc) throw IoError("its CRC is another");
  return {data, static_cast<std::size_t>(length)};
}

Index index_of(const InputFile& file) {
  char start[8] = {};
  if (file.size() >= sizeof start) file.read(0, start, sizeof start);
  if (std::string_view(start, sizeof start) != kMagic) throw IoError("does not begin as MCAP does");
  std::string problem = "it says not where all messages are";
  try {
    if (std::optional<Index> index = by_summary(file)) return std::move(*index);
  } catch (const IoError& error) {
    problem = error.what();
  }
  Index index = Scan(file).all();
  index.remarks.insert(index.remarks.begin(),
                       "without an index (" + problem + "): all of it was looked through");
  return index;
}

}  // namespace mcap
}  // namespace pcl_bv
