// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "fields.h"
#include "ply_format.h"
#include "trailing_points.h"

namespace pcl_bv::detail {
namespace {

/// Reads the bytes of a file in sequence. Small values are read through a buffer of 64 KiB.
class ByteStream {
 public:
  ByteStream(const InputFile& file, std::size_t offset) : file_(file), at_(offset) {}

  std::size_t left() const { return file_.size() - at_; }

  /// For skip(), read_all() and read_few(), `bytes` must be at most left().
  void skip(std::size_t bytes) { at_ += bytes; }
  void read_all(std::byte* to, std::size_t bytes) {
    file_.read(at_, to, bytes);
    at_ += bytes;
  }
  void read_few(std::byte* to, std::size_t bytes) {
    if (at_ < window_begin_ || at_ + bytes > window_end_) fill();
    std::memcpy(to, window_.data() + (at_ - window_begin_), bytes);
    at_ += bytes;
  }

 private:
  void fill() {
    window_begin_ = at_;
    window_end_ = at_ + std::min(left(), window_.size());
    file_.read(at_, window_.data(), window_end_ - window_begin_);
  }

  const InputFile& file_;
  std::size_t at_;
  std::size_t window_begin_ = 0, window_end_ = 0;
  std::array<std::byte, 65536> window_;
};

// Reads elements in the order of the file.
class ElementReader {
 public:
  ElementReader(const InputFile& file, const PlyHeader& header)
      : stream_(file, header.data_offset), swap_(header.encoding == PlyEncoding::big_endian) {}

  std::size_t left() const { return stream_.left(); }

  void skip(const PlyElement& element) {
    require_available(element);
    if (!element.has_lists()) return stream_.skip(element.count * element.fixed_bytes());
    std::array<std::byte, 8> ignored;
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties)
        take(element, i, property, ignored.data());
    }
  }

  void read(const PlyElement& vertex, RawCloud& cloud) {
    require_available(vertex);
    cloud.data.resize(cloud.size() * cloud.point_step);
    if (!vertex.has_lists()) {
      stream_.read_all(cloud.data.data(), cloud.data.size());
    } else {
      std::byte* to = cloud.data.data();
      for (std::size_t i = 0; i < vertex.count; ++i) {
        for (const PlyProperty& property : vertex.properties) {
          take(vertex, i, property, to);
          if (!property.is_list) to += property.value.size;
        }
      }
    }
    if (swap_) swap_fields(cloud);
  }

 private:
  void require_available(const PlyElement& element) const {
    const std::size_t bytes = element.fixed_bytes();
    if (bytes == 0 || element.count <= stream_.left() / bytes) return;
    throw IoError("truncated: " + std::to_string(element.count) + " of element " + in_quotes(element.name) +
                  " take at least " + std::to_string(bytes) + " bytes each, the file has " +
                  std::to_string(stream_.left()));
  }

  // Copies a value in the file's byte order, or skips a list.
  void take(const PlyElement& element, std::size_t i, const PlyProperty& property, std::byte* to) {
    const auto need = [&](std::uint64_t bytes) {
      if (bytes <= stream_.left()) return;
      throw IoError("truncated: " + in_quotes(element.name) + " " + std::to_string(i) + " of " +
                    std::to_string(element.count) + " is not complete");
    };
    need(property.fixed_bytes());
    if (!property.is_list) return stream_.read_few(to, property.value.size);
    const std::int64_t n = list_size(property.count);
    if (n < 0) {
      throw IoError("corrupt: " + in_quotes(element.name) + " " + std::to_string(i) + " has a list of " +
                    std::to_string(n) + " values");
    }
    const std::uint64_t bytes = static_cast<std::uint64_t>(n) * property.value.size;
    need(bytes);
    stream_.skip(bytes);
  }

  std::int64_t list_size(const PointField& count) {
    std::array<std::byte, 8> bytes;
    stream_.read_few(bytes.data(), count.size);
    if (swap_) std::reverse(bytes.begin(), bytes.begin() + count.size);
    return with_element_type(count, [&](auto value) {
      std::memcpy(&value, bytes.data(), sizeof value);
      return static_cast<std::int64_t>(value);
    });
  }

  static void swap_fields(RawCloud& cloud) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      for (const PointField& field : cloud.fields) {
        std::byte* at = &cloud.data[i * cloud.point_step + field.offset];
        std::reverse(at, at + field.size);
      }
    }
  }

  ByteStream stream_;
  bool swap_;
};

}  // namespace

void read_ply_binary(const InputFile& file, PlyHeader& header) {
  ElementReader reader(file, header);
  for (const PlyElement& element : header.skipped)
    reader.skip(element);
  reader.read(header.vertex, header.cloud);
  const bool has_rest = header.vertices_are_last && !header.vertex.has_lists();
  if (has_rest)
    note_trailing_points(file, {file.size() - reader.left(), file.size()}, header.cloud.point_step,
                         header.cloud);
}

}  // namespace pcl_bv::detail
