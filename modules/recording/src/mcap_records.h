// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads and writes MCAP records (https://mcap.dev/spec). A record is an opcode, a length, and little-endian
// fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {
namespace mcap {

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F
};

/// Bytes of a record before its fields, which are the opcode and the length.
inline constexpr std::size_t kRecordStart = 9;
/// Bytes of the footer record, including its opcode and length.
inline constexpr std::size_t kFooterBytes = kRecordStart + 20;
/// Bytes at the end of a file: the footer record, then the magic number.
inline constexpr std::size_t kFileEnd = kFooterBytes + 8;
/// Bytes of a message's fields before its data.
inline constexpr std::size_t kMessageStart = 22;

/// Reads the fields of a record in sequence. Throws IoError if the record ends within a field.
class Fields {
 public:
  Fields(const std::byte* data, std::size_t size) : data_(data), size_(size) {}

  std::size_t left() const { return size_; }
  const std::byte* here() const { return data_; }

  const std::byte* take(std::uint64_t size) {
    if (size > size_) throw IoError("a record ends within a field");
    const std::byte* const here = data_;
    data_ += size;
    size_ -= size;
    return here;
  }
  template <class T>
  T number() {
    static_assert(std::is_integral_v<T>);
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  std::string_view text() {
    const auto size = number<std::uint32_t>();
    return {reinterpret_cast<const char*>(take(size)), size};
  }
  /// Reads a list or map and returns its content as fields.
  Fields list() {
    const auto size = number<std::uint32_t>();
    return {take(size), size};
  }

 private:
  const std::byte* data_;
  std::size_t size_;
};

struct Record {
  Op op;
  const std::byte* data;
  std::size_t size;

  Fields fields() const { return {data, size}; }
};

/// Reads the next record of a sequence.
inline Record take_record(Fields& records) {
  const auto op = records.number<std::uint8_t>();
  const auto size = records.number<std::uint64_t>();
  return {static_cast<Op>(op), records.take(size), static_cast<std::size_t>(size)};
}

/// Appends records to a vector of bytes.
class Writer {
 public:
  explicit Writer(std::vector<std::byte>& to) : to_(to) {}

  void begin(Op op) {
    number(static_cast<std::uint8_t>(op));
    number(std::uint64_t{0});
    begin_ = to_.size();
  }
  void end() { set(begin_ - 8, static_cast<std::uint64_t>(to_.size() - begin_)); }

  template <class T>
  void number(T value) {
    static_assert(std::is_integral_v<T>);
    bytes(&value, sizeof value);
  }
  void bytes(const void* data, std::size_t size) {
    const auto* const first = static_cast<const std::byte*>(data);
    if (size > 0) to_.insert(to_.end(), first, first + size);
  }
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes(text.data(), text.size());
  }
  /// Appends a list or map. write() appends its content.
  template <class Write>
  void list(Write write) {
    number(std::uint32_t{0});
    const std::size_t first = to_.size();
    write();
    set(first - 4, static_cast<std::uint32_t>(to_.size() - first));
  }
  /// Overwrites the bytes at position `at`.
  template <class T>
  void set(std::size_t at, T value) {
    std::memcpy(to_.data() + at, &value, sizeof value);
  }

 private:
  std::vector<std::byte>& to_;
  std::size_t begin_ = 0;
};

// The records of an MCAP file that put() and take() write and read. The callers of put() and take() compute
// and check CRCs.

struct Schema {
  std::uint16_t id = 0;
  std::string name, encoding, data;
};

struct Channel {
  std::uint16_t id = 0, schema = 0;
  std::string topic, encoding;
  std::map<std::string, std::string> metadata;
};

struct MessageTime {
  std::uint64_t time, offset;  ///< `offset` is from the beginning of the uncompressed chunk.
};

struct ChunkIndex {
  std::uint64_t first_time = 0, last_time = 0, offset = 0, bytes = 0;
  std::map<std::uint16_t, std::uint64_t> indexes;  ///< Position of the message index of each channel.
  std::uint64_t index_bytes = 0;
  std::string compression;
  std::uint64_t compressed = 0, uncompressed = 0;
};

struct AttachmentIndex {
  std::uint64_t offset = 0, bytes = 0, log_time = 0, create_time = 0, size = 0;
  std::string name, media_type;
};

struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0, attachments = 0, metadata = 0, chunks = 0;
  std::uint64_t first_time = 0, last_time = 0;
  std::map<std::uint16_t, std::uint64_t> channel_messages;
};

void put(Writer& writer, const Schema& schema);
void put(Writer& writer, const Channel& channel);
void put(Writer& writer, std::uint16_t channel, const std::vector<MessageTime>& index);
void put(Writer& writer, const ChunkIndex& index);
void put(Writer& writer, const AttachmentIndex& index);
void put(Writer& writer, const Statistics& statistics);

/// These functions read a record. They throw IoError if the record ends within a field. Further fields of
/// later versions are ignored.
void take(Fields fields, Schema& schema);
void take(Fields fields, Channel& channel);
void take(Fields fields, ChunkIndex& index);
void take(Fields fields, Statistics& statistics);

}  // namespace mcap
}  // namespace pcl_bv::detail
