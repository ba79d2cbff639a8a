// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "mcap_index.h"

#include <algorithm>
#include <optional>

#include "mcap_scan.h"
#include "pcl_bv/io/crc32.h"

namespace pcl_bv::detail {
namespace mcap {
namespace {

// Returns the records of the summary, or none if there is no summary. Throws IoError if the file or the
// summary is damaged.
std::vector<std::byte> read_summary(const InputFile& file) {
  const std::uint64_t size = file.size();
  if (size < kMagic.size() + kFileEnd) throw IoError("the file is truncated");
  const std::vector<std::byte> end = bytes_at(file, size - kFileEnd, kFileEnd);
  if (std::memcmp(end.data() + kFooterBytes, kMagic.data(), kMagic.size()) != 0)
    throw IoError("the file is truncated");
  Fields fields(end.data(), kFooterBytes);
  const Record footer = take_record(fields);
  if (footer.op != Op::footer) throw IoError("the file has no footer");
  Fields values = footer.fields();
  const auto start = values.number<std::uint64_t>();
  values.number<std::uint64_t>();  // position of the summary offset records, which is not needed
  const auto crc = values.number<std::uint32_t>();
  if (start == 0) return {};
  if (start < kMagic.size() || start > size - kFileEnd)
    throw IoError("the summary's offset is outside the file");
  std::vector<std::byte> summary = bytes_at(file, start, size - start);
  if (crc != 0 && crc32_of(summary.data(), summary.size() - kMagic.size() - 4) != crc)
    throw IoError("the summary is damaged");
  summary.resize(summary.size() - kFileEnd);
  return summary;
}

void note_chunk(const Record& record, std::uint64_t end, Summary& summary) {
  ChunkIndex chunk;
  take(record.fields(), chunk);
  if (chunk.offset > end || chunk.bytes > end - chunk.offset)
    throw IoError("a chunk lies outside of the file");
  if (chunk.bytes < kRecordStart) throw IoError("a chunk is shorter than a record");
  Part& part = summary.chunks[chunk.offset];
  part = {chunk.offset, chunk.bytes, chunk.first_time, chunk.last_time};
  for (const auto& [channel, offset] : chunk.indexes)
    part.channels.insert(channel);
  summary.index_bytes[chunk.offset] = chunk.index_bytes;
}

// Throws IoError for overlapping chunks. Otherwise each entry of a short summary could refer to the whole
// file, which would then be read many times.
void require_disjoint(const std::map<std::uint64_t, Part>& chunks) {
  std::uint64_t end = 0;
  for (const auto& [offset, chunk] : chunks) {
    if (offset < end) throw IoError("two chunks overlap");
    end = offset + chunk.bytes;
  }
}

// Returns whether the index has all channels that occur in the summary's channel, statistics and chunk index
// records, and the schemas of these channels.
bool describes_channels(const Summary& summary, const Index& index) {
  const auto known = [&](std::uint16_t id) {
    const auto channel = index.channels.find(id);
    return channel != index.channels.end() &&
           (channel->second.schema == 0 || index.schemas.count(channel->second.schema) > 0);
  };
  const auto first_known = [&](const auto& pair) { return known(pair.first); };
  return std::all_of(index.channels.begin(), index.channels.end(), first_known) &&
         (!summary.statistics || std::all_of(summary.statistics->channel_messages.begin(),
                                             summary.statistics->channel_messages.end(), first_known)) &&
         std::all_of(summary.chunks.begin(), summary.chunks.end(), [&](const auto& chunk) {
           const std::set<std::uint16_t>& channels = chunk.second.channels;
           return std::all_of(channels.begin(), channels.end(), known);
         });
}

// Reads the summary. Returns nullopt if the summary has no channels, has no chunks, or does not describe all
// channels.
std::optional<Summary> read_summary_index(const InputFile& file, Index& index) {
  const std::vector<std::byte> bytes = read_summary(file);
  Summary summary;
  for (Fields records(bytes.data(), bytes.size()); records.left() > 0;) {
    const Record record = take_record(records);
    add_schema_or_channel(record, index);
    if (record.op == Op::chunk_index) note_chunk(record, file.size(), summary);
    if (record.op == Op::statistics) take(record.fields(), summary.statistics.emplace());
  }
  require_disjoint(summary.chunks);
  if (index.channels.empty() || summary.chunks.empty() || !describes_channels(summary, index))
    return std::nullopt;
  return summary;
}

}  // namespace

Fields load_part(const InputFile& file, const Part& part, Decompressor& decompressor,
                 std::vector<std::byte>& raw, std::vector<std::byte>& unpacked) {
  raw.resize(part.bytes);
  file.read(part.offset, raw.data(), raw.size());
  Fields all(raw.data(), raw.size());
  if (!part.is_chunk) return all;
  const Record record = take_record(all);
  if (record.op != Op::chunk) throw IoError("not a chunk record");
  Fields fields = record.fields();
  fields.take(16);  // first and last time
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
  if (crc != 0 && crc32_of(data, length) != crc) throw IoError("its CRC does not match");
  return {data, static_cast<std::size_t>(length)};
}

Index index_of(const InputFile& file) {
  char start[8] = {};
  if (file.size() >= sizeof start) file.read(0, start, sizeof start);
  if (std::string_view(start, sizeof start) != kMagic) throw IoError("does not begin as MCAP does");
  std::string problem = "the summary does not describe all channels and chunks";
  Index index;
  std::optional<Summary> summary;
  try {
    summary = read_summary_index(file, index);
  } catch (const IoError& error) {
    problem = error.what();
  }
  if (!summary) {
    index = Index();
    index.warnings.add("no usable index (" + problem + "): the whole file was scanned");
    mcap::scan(file, Summary(), index);
    return index;
  }
  const UnindexedCounts unindexed = mcap::scan(file, *summary, index);
  const std::optional<Statistics>& counted = summary->statistics;
  if (counted && counted->chunks == summary->chunks.size() && unindexed.chunks == 0 &&
      unindexed.loose_messages == 0)
    index.messages = counted->channel_messages;
  return index;
}

}  // namespace mcap
}  // namespace pcl_bv::detail
