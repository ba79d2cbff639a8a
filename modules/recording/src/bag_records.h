// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parses the records of ROS 1 bags. A record is a header of named fields, then data.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

#include "pcl_bv/io/raw_cloud.h"

namespace pcl_bv::detail {

enum class BagOp : std::uint8_t { message = 2, bag_header, index, chunk, chunk_info, connection };

inline constexpr std::size_t kMagicBytes = 13;

// Reads bytes in sequence. Throws IoError if the remaining bytes are too few.
class BagBytes {
 public:
  BagBytes(const std::byte* data, std::size_t size) : data_(data), size_(size) {}
  std::size_t left() const { return size_; }
  const std::byte* take(std::size_t size) {
    if (size > size_) throw IoError("a record ends within a field");
    const std::byte* const here = data_;
    data_ += size;
    size_ -= size;
    return here;
  }
  std::uint32_t length() {
    std::uint32_t value;
    std::memcpy(&value, take(4), 4);
    return value;
  }

 private:
  const std::byte* data_;
  std::size_t size_;
};

// The fields of a header. In the file, each field is a length and "name=value".
class BagHeader {
 public:
  BagHeader(const std::byte* data, std::size_t size) {
    for (BagBytes bytes(data, size); bytes.left() > 0;) {
      const std::uint32_t length = bytes.length();
      const std::string_view field(reinterpret_cast<const char*>(bytes.take(length)), length);
      const std::size_t equals = std::min(field.find('='), field.size());
      fields_[field.substr(0, equals)] = field.substr(std::min(equals + 1, field.size()));
    }
  }

  template <class T>
  T number(std::string_view name) const {
    const std::string_view text = this->text(name);
    T value{};
    if (text.size() != sizeof value) throw IoError("a record without its " + std::string(name));
    std::memcpy(&value, text.data(), sizeof value);
    return value;
  }
  std::string_view text(std::string_view name) const {
    const auto found = fields_.find(name);
    return found == fields_.end() ? std::string_view() : found->second;
  }
  BagOp op() const { return static_cast<BagOp>(number<std::uint8_t>("op")); }

  // Returns nanoseconds since 1970. The file stores seconds and nanoseconds, 32 bits each.
  std::int64_t time(std::string_view name) const {
    const auto both = number<std::uint64_t>(name);
    return static_cast<std::int64_t>((both & 0xFFFFFFFFU) * 1'000'000'000U + (both >> 32U));
  }

 private:
  std::map<std::string_view, std::string_view> fields_;
};

struct BagRecord {
  BagHeader header;
  const std::byte* data;
  std::size_t size;
};

inline BagRecord take_bag_record(BagBytes& bytes) {
  const std::uint32_t header_size = bytes.length();
  const std::byte* const header = bytes.take(header_size);
  const std::uint32_t size = bytes.length();
  return {BagHeader(header, header_size), bytes.take(size), size};
}

}  // namespace pcl_bv::detail
