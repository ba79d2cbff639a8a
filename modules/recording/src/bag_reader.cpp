// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads ROS 1 bags (http://wiki.ros.org/Bags/Format/2.0).

#include <bzlib.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "bag_records.h"
#include "chunked_reader.h"
#include "formats.h"
#include "pcl_bv/io/posix_file.h"
#include "search.h"

namespace pcl_bv::detail {
namespace {

void unpack_bz2(const std::byte* data, std::size_t size, std::size_t expected, std::vector<std::byte>& to) {
  // Limits the memory that a small file can request. bz2 can compress by a factor of 20 000, but real data of
  // more than 8 MiB is not compressed by more than 1000.
  if (expected > std::max<std::size_t>(8U << 20U, 1000 * size))
    throw IoError("bz2: " + std::to_string(size) + " bytes for " + std::to_string(expected));
  to.resize(expected);
  auto made = static_cast<unsigned>(expected);
  const int status = BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(to.data()), &made,
                                                const_cast<char*>(reinterpret_cast<const char*>(
                                                    data)),  // NOLINT(cppcoreguidelines-pro-type-const-cast)
                                                static_cast<unsigned>(size), 0, 0);
  if (status != BZ_OK || made != expected) throw IoError("bz2: not " + std::to_string(expected) + " bytes");
}

// The header of a record, and the position and size of its data, which has not been read.
struct BagRecordLocation {
  std::vector<std::byte> header;
  std::uint64_t data = 0, size = 0;
};

// Maximum bytes of a header. Most headers have a topic's name and a few numbers. The header of a chunk has
// only the compression and the size.
constexpr std::uint64_t kMaxHeader = 1U << 20U, kMaxChunkHeader = 256;

class BagReader final : public ChunkedReader {
 public:
  explicit BagReader(const std::filesystem::path& path) : file_(path) {
    if (!read_index_or_warn()) {
      scan();
      sort_offsets();
    }
    start(std::move(found_topics_.all()), std::move(found_parts_));
  }

 private:
  // Returns the record at `at`. Returns nullopt if it exceeds the file or its header exceeds `max_header`
  // bytes.
  std::optional<BagRecordLocation> record_at(std::uint64_t at, std::uint64_t max_header = kMaxHeader) const {
    const std::uint64_t size = file_.size();
    if (at + 4 > size) return std::nullopt;
    std::uint32_t length = 0;
    file_.read(at, &length, 4);
    if (length > max_header || length > size - at - 4 || size - at - 4 - length < 4) return std::nullopt;
    BagRecordLocation location;
    location.header.resize(length);
    file_.read(at + 4, location.header.data(), length);
    std::uint32_t data = 0;
    file_.read(at + 4 + length, &data, 4);
    location.data = at + 8 + length;
    location.size = data;
    if (data > size - location.data) return std::nullopt;
    return location;
  }

  std::vector<std::byte> bytes_of(const BagRecordLocation& location) const {
    std::vector<std::byte> bytes(location.size);
    if (!bytes.empty()) file_.read(location.data, bytes.data(), bytes.size());
    return bytes;
  }

  void note_connection(const BagHeader& header, const std::byte* data, std::size_t size) {
    const auto id = header.number<std::uint32_t>("conn");
    if (topic_of_.count(id) > 0) return;
    const BagHeader connection(data, size);
    topic_of_[id] =
        found_topics_.add({std::string(header.text("topic")), ros2_type(connection.text("type")), "ros1"});
  }

  // Reads the index at the file's end, which has the connections and the positions of the chunks. If the
  // index is missing or damaged, adds a warning and returns false.
  bool read_index_or_warn() {
    std::string problem = "the recording was not closed";
    try {
      const std::optional<BagRecordLocation> head = record_at(kMagicBytes);
      const BagHeader header =
          head ? BagHeader(head->header.data(), head->header.size()) : BagHeader(nullptr, 0);
      const auto index = header.number<std::uint64_t>("index_pos");
      const auto chunks = header.number<std::uint32_t>("chunk_count");
      if (index >= kMagicBytes && index < file_.size() && read_index(index) &&
          found_parts_.size() == chunks && sort_offsets())
        return true;
      if (index != 0) problem = "the index is incomplete";
    } catch (const IoError& error) {
      problem = error.what();
    }
    add_warning("no usable index (" + problem + "): the whole file was scanned");
    found_topics_ = {};
    topic_of_.clear();
    found_parts_.clear();
    return false;
  }

  bool read_index(std::uint64_t at) {
    for (; at < file_.size();) {
      const std::optional<BagRecordLocation> location = record_at(at);
      if (!location) return false;
      const BagHeader header(location->header.data(), location->header.size());
      const std::vector<std::byte> data = bytes_of(*location);
      if (header.op() == BagOp::connection) note_connection(header, data.data(), data.size());
      if (header.op() == BagOp::chunk_info) {
        Part& part = found_parts_.emplace_back();
        part = {header.number<std::uint64_t>("chunk_pos"), header.time("start_time")};
        if (part.offset >= file_.size()) return false;
        for (BagBytes counts(data.data(), data.size()); counts.left() > 0;) {
          const auto topic = topic_of_.find(counts.length());
          const std::uint32_t messages = counts.length();
          if (topic == topic_of_.end()) return false;
          part.topics.push_back(topic->second);
          found_topics_.all()[topic->second].messages += messages;
        }
      }
      at = location->data + location->size;
    }
    return true;
  }

  // Sorts the positions of the chunks. Returns false if two chunks have the same position.
  bool sort_offsets() {
    offsets_.clear();
    for (const Part& part : found_parts_)
      offsets_.push_back(part.offset);
    std::sort(offsets_.begin(), offsets_.end());
    return std::adjacent_find(offsets_.begin(), offsets_.end()) == offsets_.end();
  }

  void scan() {
    std::vector<std::byte> raw, unpacked;
    Decompressor decompressor;
    std::uint64_t previous = 0;  // position of the last record, whose length may be damaged
    for (std::uint64_t at = kMagicBytes; at < file_.size();) {
      const std::optional<BagRecordLocation> location = record_at(at);
      const std::optional<BagOp> op = location ? op_of(*location) : std::nullopt;
      if (!op) {
        const std::uint64_t from = std::max(previous, std::uint64_t{kMagicBytes}) + 1;
        const std::uint64_t found = find_chunk(from);
        add_warning(found == file_.size() ? "the file ends within a record, at byte " + std::to_string(at)
                                          : skipped_bytes(found > at ? at : from - 1, found));
        previous = at = found;
        continue;
      }
      try {
        const BagHeader header(location->header.data(), location->header.size());
        if (*op == BagOp::connection) {
          const std::vector<std::byte> data = bytes_of(*location);
          note_connection(header, data.data(), data.size());
        } else if (*op == BagOp::chunk) {
          scan_chunk(at, unpack(*location, decompressor, raw, unpacked));
        }
      } catch (const IoError& error) {
        add_warning("skipped the record at byte " + std::to_string(at) + ": " + error.what());
      }
      previous = at;
      at = location->data + location->size;
    }
  }

  static std::optional<BagOp> op_of(const BagRecordLocation& location) {
    try {
      return BagHeader(location.header.data(), location.header.size()).op();
    } catch (const IoError&) {
      return std::nullopt;
    }
  }

  // Returns the position of the next chunk, or the file's end if there is none. A chunk is found by the field
  // "op" of its header.
  std::uint64_t find_chunk(std::uint64_t from) const {
    constexpr std::string_view mark("\x04\0\0\0op=\x05", 8);
    std::uint64_t chunk = file_.size();
    find_in_file(file_, from, file_.size(), mark.size(),
                 [&](const std::byte* bytes, std::size_t size, std::uint64_t at) {
                   if (*bytes != std::byte{4} || size < mark.size() ||
                       std::memcmp(bytes, mark.data(), mark.size()) != 0)
                     return false;
                   chunk = chunk_around(at, at + mark.size(), from);
                   return chunk < file_.size();
                 });
    return chunk;
  }

  // Returns the position of the chunk whose header contains the bytes [begin, end). The search goes backwards
  // from `begin` by at most kMaxChunkHeader bytes and stops at `from`. Returns the file's end if there is no
  // such chunk.
  std::uint64_t chunk_around(std::uint64_t begin, std::uint64_t end, std::uint64_t from) const {
    const std::uint64_t lowest = std::max(from, begin - std::min(begin, kMaxChunkHeader));
    std::vector<std::byte> bytes(begin - lowest + 4);
    file_.read(lowest, bytes.data(), bytes.size());
    for (std::uint64_t at = begin; at-- > lowest;) {
      std::uint32_t length = 0;
      std::memcpy(&length, bytes.data() + (at - lowest), sizeof length);
      if (length > kMaxChunkHeader || at + 8 + length <= end) continue;  // saves three reads of the file
      const std::optional<BagRecordLocation> location = record_at(at, kMaxChunkHeader);
      if (location && location->data > end && op_of(*location) == BagOp::chunk) return at;
    }
    return file_.size();
  }

  void scan_chunk(std::uint64_t at, BagBytes records) {
    const std::size_t part = found_parts_.size();
    found_parts_.push_back({at, std::numeric_limits<std::int64_t>::max()});
    while (records.left() > 0) {
      const BagRecord record = take_bag_record(records);
      if (record.header.op() == BagOp::connection) note_connection(record.header, record.data, record.size);
      if (record.header.op() != BagOp::message) continue;
      std::int64_t& first = found_parts_[part].first_time_ns;
      first = std::min(first, record.header.time("time"));
    }
  }

  BagBytes unpack(const BagRecordLocation& location, Decompressor& decompressor, std::vector<std::byte>& raw,
                  std::vector<std::byte>& unpacked) const {
    const BagHeader header(location.header.data(), location.header.size());
    if (header.op() != BagOp::chunk) throw IoError("not a chunk record");
    const auto expected = header.number<std::uint32_t>("size");
    const std::string_view compression = header.text("compression");
    raw.resize(location.size);
    if (!raw.empty()) file_.read(location.data, raw.data(), raw.size());
    if (compression == "none") {
      if (expected != raw.size())
        throw IoError("it has " + std::to_string(raw.size()) + " bytes, not " + std::to_string(expected));
      return {raw.data(), raw.size()};
    }
    if (compression == "bz2") {
      unpack_bz2(raw.data(), raw.size(), expected, unpacked);
    } else if (compression == "lz4") {
      decompressor.decompress(Compression::lz4, raw.data(), raw.size(), expected, unpacked);
    } else {
      throw IoError("its compression is " + in_quotes(compression));
    }
    return {unpacked.data(), unpacked.size()};
  }

  void load(std::size_t part, Buffers& buffers, std::vector<RecordedMessage>& messages) override {
    const std::optional<BagRecordLocation> location = record_at(part_offset(part));
    if (!location) throw IoError("it is cut");
    // Refuse overlapping chunks. Otherwise each entry of a small file's index could refer to most of the
    // file, which would then be read many times.
    const auto next = std::upper_bound(offsets_.begin(), offsets_.end(), part_offset(part));
    if (next != offsets_.end() && location->data + location->size > *next)
      throw IoError("the chunk overlaps the next one");
    file_.require_unchanged();
    auto records =
        unpack_shared<BagBytes>(cache_, part_offset(part), buffers.shared, buffers.unpacked,
                                [&](auto& to) { return unpack(*location, decompressor(), buffers.raw, to); });
    while (records.left() > 0) {
      const BagRecord record = take_bag_record(records);
      if (record.header.op() != BagOp::message) continue;
      const auto topic = topic_of_.find(record.header.number<std::uint32_t>("conn"));
      if (topic == topic_of_.end() || !wanted(topic->second)) continue;
      const std::int64_t time = record.header.time("time");
      messages.push_back({topic->second, time, time, record.data, record.size});
    }
  }

  InputFile file_;
  std::shared_ptr<ChunkCache> cache_ = ChunkCache::of(file_);
  TopicList found_topics_;                         // moved to the base class by start()
  std::vector<Part> found_parts_;                  // moved to the base class by start()
  std::vector<std::uint64_t> offsets_;             // positions of the chunks, ascending
  std::map<std::uint32_t, std::size_t> topic_of_;  // index in the topics, by connection id
};

}  // namespace

std::unique_ptr<RecordingReader> open_bag(const std::filesystem::path& file) {
  return std::make_unique<BagReader>(file);
}

}  // namespace pcl_bv::detail
