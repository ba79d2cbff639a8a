// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads and writes messages as bytes, in ROS 1's encoding or in ROS 2's encoding CDR. A message in CDR is an
// encapsulation header of four bytes, then "plain CDR" (OMG DDSI-RTPS). Readers and writers visit the fields
// through each_field() of types.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "pcl_bv/messages/records.h"
#include "pcl_bv/messages/types.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Error thrown if bytes are not a message of the requested type. what() is the reason in one line.
class MessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Encodings of messages, which are ROS 2's CDR and ROS 1's encoding.
enum class MessageEncoding : std::uint8_t { cdr, ros1 };

/// Appends a message to a vector of bytes, little-endian.
template <MessageEncoding encoding>
class MessageWriter {
 public:
  static constexpr bool ros1 = encoding == MessageEncoding::ros1;

  explicit MessageWriter(std::vector<std::byte>& to) : to_(to) {
    if constexpr (!ros1) put("\0\1\0\0", 4);
    begin_ = to.size();
  }

  /// Writes the fields in this order.
  template <class... Fields>
  void operator()(const Fields&... fields) {
    (write(fields), ...);
  }

 private:
  void put(const void* data, std::size_t size) {
    if (size == 0) return;
    const auto* const bytes = static_cast<const std::byte*>(data);
    to_.insert(to_.end(), bytes, bytes + size);
  }
  void align(std::size_t size) {
    if constexpr (!ros1) to_.resize(begin_ + (to_.size() - begin_ + size - 1) / size * size);
  }
  template <class T>
  void write(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      write(static_cast<std::uint8_t>(value));
    } else if constexpr (std::is_arithmetic_v<T>) {
      align(sizeof(T));
      put(&value, sizeof(T));
    } else {
      T::each_field(value, *this);
    }
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size() + (ros1 ? 0 : 1)));
    put(text.c_str(), text.size() + (ros1 ? 0 : 1));
  }
  void write(const msg::Bytes& bytes) {
    write(static_cast<std::uint32_t>(bytes.size));
    put(bytes.data, bytes.size);
  }
  template <class T>
  void write(const std::vector<T>& list) {
    write(static_cast<std::uint32_t>(list.size()));
    for (const T& element : list)
      write(element);
  }
  template <class T, std::size_t n>
  void write(const std::array<T, n>& list) {
    for (const T& element : list)
      write(element);
  }

  std::vector<std::byte>& to_;
  std::size_t begin_ = 0;
};

/// Reads a message. Never reads beyond the end of the message. A list grows element by element, so that a
/// wrong length cannot cause a large allocation.
template <MessageEncoding encoding>
class MessageReader {
 public:
  static constexpr bool ros1 = encoding == MessageEncoding::ros1;

  /// Throws MessageError if a CDR message does not have the encapsulation header of plain CDR.
  MessageReader(const std::byte* data, std::size_t size) : data_(data), size_(size) {
    if constexpr (!ros1) {
      if (size < 4)
        throw MessageError("the message has no encapsulation: it has " + std::to_string(size) + " bytes");
      const auto kind = std::to_integer<unsigned>(data[0]) << 8 | std::to_integer<unsigned>(data[1]);
      if (kind > 1)
        throw MessageError("the encapsulation is " + std::to_string(kind) + ", not 0 or 1 of plain CDR");
      swap_ = kind == 0;
      data_ += 4;
      size_ -= 4;
    }
  }

  /// Reads the fields in this order. Throws MessageError if the message ends too early.
  template <class... Fields>
  void operator()(Fields&... fields) {
    (read(fields), ...);
  }

  /// Throws MessageError if bytes remain after the last field, because the message then has another version
  /// of its type. CDR messages may have up to 7 extra bytes, because some middleware adds padding.
  void finish() const {
    if (size_ - at_ >= (ros1 ? 1 : 8))
      throw MessageError(std::to_string(size_ - at_) +
                         " extra bytes after the last field: the message has another version of its type");
  }

 private:
  const std::byte* take(std::size_t size) {
    if (size > size_ - at_)
      throw MessageError("the message ends within a field, after " + std::to_string(size_) + " bytes");
    const std::byte* const here = data_ + at_;
    at_ += size;
    return here;
  }
  void align(std::size_t size) {
    if constexpr (!ros1) take(std::min((size - at_ % size) % size, size_ - at_));
  }
  template <class T>
  void read(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte;
      read(byte);
      value = byte != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      align(sizeof(T));
      std::byte bytes[sizeof(T)];
      std::memcpy(bytes, take(sizeof(T)), sizeof(T));
      if (swap_) std::reverse(bytes, bytes + sizeof(T));
      std::memcpy(&value, bytes, sizeof(T));
    } else {
      T::each_field(value, *this);
    }
  }
  std::uint32_t read_length() {
    std::uint32_t length;
    read(length);
    return length;
  }
  void read(std::string& text) {
    const std::uint32_t length = read_length();
    const auto* const characters = reinterpret_cast<const char*>(take(length));
    // CDR strings end with a null, but some writers leave the null out for an empty string.
    text.assign(characters, ros1 || length == 0 ? length : length - 1);
  }
  void read(msg::Bytes& bytes) {
    bytes.size = read_length();
    bytes.data = take(bytes.size);
  }
  template <std::size_t bytes, std::size_t alignment>
  void read(msg::Records<bytes, alignment>& list) {
    list.count = read_length();
    list.stride = ros1 ? bytes : (bytes + alignment - 1) / alignment * alignment;
    list.swapped = swap_;
    if (list.count == 0) return;
    align(alignment);
    list.data = take((list.count - 1) * list.stride + bytes);
  }
  template <class T>
  void read(std::vector<T>& list) {
    const std::uint32_t length = read_length();
    list.clear();
    for (std::uint32_t i = 0; i < length; ++i)
      read(list.emplace_back());
  }
  template <class T, std::size_t n>
  void read(std::array<T, n>& list) {
    for (T& element : list)
      read(element);
  }

  const std::byte* data_;
  std::size_t size_;
  std::size_t at_ = 0;
  bool swap_ = false;
};

/// Appends the message in CDR.
template <class Message>
void write_cdr(const Message& message, std::vector<std::byte>& to) {
  MessageWriter<MessageEncoding::cdr> writer(to);
  writer(message);
}
/// Appends the message in ROS 1's encoding.
template <class Message>
void write_ros1(const Message& message, std::vector<std::byte>& to) {
  MessageWriter<MessageEncoding::ros1> writer(to);
  writer(message);
}

/// Reads a message in CDR. Fields of type msg::Bytes refer to `data`. Throws MessageError if the bytes are
/// not a message of this type.
template <class Message>
void read_cdr(const std::byte* data, std::size_t size, Message& message) {
  MessageReader<MessageEncoding::cdr> reader(data, size);
  reader(message);
  reader.finish();
}
/// Reads a message in ROS 1's encoding. Otherwise like read_cdr().
template <class Message>
void read_ros1(const std::byte* data, std::size_t size, Message& message) {
  MessageReader<MessageEncoding::ros1> reader(data, size);
  reader(message);
  reader.finish();
}
/// Returns the message in ROS 1's encoding or in CDR. Otherwise like read_cdr().
template <class Message>
Message read_message(const std::byte* data, std::size_t size, bool ros1) {
  Message message;
  if (ros1) {
    read_ros1(data, size, message);
  } else {
    read_cdr(data, size, message);
  }
  return message;
}

}  // namespace pcl_bv
