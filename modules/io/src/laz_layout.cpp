// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The record "laszip encoded" (22204) and the table of chunks, as in Isenburg's LASzip 3. The record has the
// compressor (u16 at 0), the coder (u16 at 2), the points of a chunk (u32 at 12), the number of items (u16 at
// 32) and the items: type, size and version (u16 each). An item is a part of a point with a compression of
// its own.

#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>

#include "fields.h"
#include "las_format.h"
#include "laz_chunk_table.h"
#include "laz_format.h"

namespace pcl_bv::detail {
namespace {

struct LazItem {
  std::uint16_t type, size, version;
};

enum LazItemType : std::uint16_t {
  bytes10 = 0,
  point10 = 6,
  time11 = 7,
  color12 = 8,
  wave13 = 9,
  point14 = 10,
  color14 = 11,
  color_nir14 = 12,
  wave14 = 13,
  bytes14 = 14
};

constexpr std::size_t kLaszipHead = 34, kLaszipItem = 6;

// Maximum number of variable length records before the points. Files have fewer than ten.
constexpr std::uint32_t kMaxRecords = 1U << 16U;

// A file with more points for each of its bytes is refused. A point of a map takes some bytes; of equal
// points, up to 700 share a byte.
constexpr std::uint64_t kMaxPointsPerByte = 4096;

// Maximum number of extra bytes of a point. Files have fewer than 100. LASzip takes 2.3 kB for each.
constexpr std::size_t kMaxExtraBytes = 4096;

// The value of a fixed number of points per chunk that means a number for each chunk.
constexpr std::uint32_t kVariablePoints = std::numeric_limits<std::uint32_t>::max();

template <typename T>
T value_at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

template <typename T>
T read_value(const InputFile& file, std::size_t offset) {
  T value;
  file.read(offset, &value, sizeof value);
  return value;
}

// Returns the data of the record "laszip encoded".
std::string find_record(const InputFile& file, std::size_t data_offset) {
  constexpr std::size_t head = 54;
  const std::uint32_t records = std::min(read_value<std::uint32_t>(file, 100), kMaxRecords);
  std::size_t at = read_value<std::uint16_t>(file, 94);
  const std::size_t end = std::min(data_offset, file.size());
  std::string bytes(head, '\0');
  for (std::uint32_t i = 0; i < records && at <= end && end - at >= head; ++i) {
    file.read(at, bytes.data(), head);
    const auto length = value_at<std::uint16_t>(bytes, 20);
    at += head;
    const std::string_view user(bytes.data() + 2, 16);
    const bool found =
        user.substr(0, user.find('\0')) == "laszip encoded" && value_at<std::uint16_t>(bytes, 18) == 22204;
    if (found && length <= end - at) {
      std::string data(length, '\0');
      file.read(at, data.data(), length);
      return data;
    }
    at += length;
  }
  throw IoError("header: the points are compressed, but the record of LASzip is missing");
}

// Returns the items of a point format, without versions.
std::vector<LazItem> items_of(unsigned format, std::size_t record) {
  const auto has = [&](std::initializer_list<unsigned> formats) {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  };
  const bool wide = format >= 6;
  std::vector<LazItem> items{wide ? LazItem{point14, 30, 0} : LazItem{point10, 20, 0}};
  if (has({1, 3, 4, 5})) items.push_back({time11, 8, 0});
  if (has({2, 3, 5})) items.push_back({color12, 6, 0});
  if (has({7})) items.push_back({color14, 6, 0});
  if (has({8, 10})) items.push_back({color_nir14, 8, 0});
  if (has({4, 5})) items.push_back({wave13, 29, 0});
  if (has({9, 10})) items.push_back({wave14, 29, 0});
  std::size_t bytes = 0;
  for (const LazItem& item : items)
    bytes += item.size;
  const auto rest = static_cast<std::uint16_t>(record - bytes);
  if (rest > 0) items.push_back({wide ? bytes14 : bytes10, rest, 0});
  return items;
}

bool is_known_version(const LazItem& item, bool wide) {
  if (wide) return item.version == 3 || item.version == 4;
  return item.version == 1 || (item.version == 2 && item.type != wave13);
}

void check_items(const std::string& record, const std::vector<LazItem>& expected, bool wide) {
  const bool fits = record.size() == kLaszipHead + expected.size() * kLaszipItem &&
                    value_at<std::uint16_t>(record, 32) == expected.size();
  if (!fits) throw IoError("header: the record of LASzip does not have the items of the point format");
  for (std::size_t i = 0; i < expected.size(); ++i) {
    LazItem item;
    std::memcpy(&item, record.data() + kLaszipHead + i * kLaszipItem, sizeof item);
    if (item.type != expected[i].type || item.size != expected[i].size || !is_known_version(item, wide))
      throw IoError("header: item " + std::to_string(i) + " of LASzip (type " + std::to_string(item.type) +
                    ", " + std::to_string(item.size) + " bytes, version " + std::to_string(item.version) +
                    ") does not belong to the point format");
  }
}

// Returns the number of sizes at the beginning of a layered chunk.
std::size_t count_layers(const std::vector<LazItem>& items) {
  std::size_t layers = 0;
  for (const LazItem& item : items)
    layers += item.type == point14 ? 9 : item.type == color_nir14 ? 2 : item.type == bytes14 ? item.size : 1;
  return layers;
}

void check_record(LazLayout& layout, std::size_t record_bytes) {
  const bool wide = layout.point_format >= 6;
  if (layout.record.size() < kLaszipHead) throw IoError("header: the record of LASzip is too short");
  layout.compressor = value_at<std::uint16_t>(layout.record, 0);
  const auto coder = value_at<std::uint16_t>(layout.record, 2);
  const bool known =
      wide ? layout.compressor == LazLayout::layered
           : layout.compressor == LazLayout::pointwise || layout.compressor == LazLayout::chunked;
  if (!known || coder != 0)
    throw IoError("header: compressor " + std::to_string(layout.compressor) + " with coder " +
                  std::to_string(coder) + " is not one of LASzip's for point format " +
                  std::to_string(layout.point_format));
  const std::vector<LazItem> items = items_of(layout.point_format, record_bytes);
  const LazItem& last = items.back();
  if ((last.type == bytes10 || last.type == bytes14) && last.size > kMaxExtraBytes)
    throw IoError("header: " + std::to_string(last.size) + " extra bytes per point, at most " +
                  std::to_string(kMaxExtraBytes) + " are read from compressed files");
  check_items(layout.record, items, wide);
  if (wide) layout.layers = count_layers(items);
}

// Returns the offset of the table of chunks. Writers that cannot seek put it at the end of the file.
std::size_t chunk_table_offset(const InputFile& file, std::size_t data_offset) {
  constexpr std::size_t pointer = sizeof(std::int64_t);
  const std::size_t size = file.size();
  if (data_offset > size || size - data_offset < 2 * pointer)
    throw IoError("truncated: the points are missing");
  auto at = read_value<std::int64_t>(file, data_offset);
  if (at == -1) at = read_value<std::int64_t>(file, size - pointer);
  if (at == static_cast<std::int64_t>(data_offset))
    throw IoError("truncated: the table of chunks is missing; the file was not written completely");
  if (at < static_cast<std::int64_t>(data_offset + pointer) || size - pointer < static_cast<std::size_t>(at))
    throw IoError("truncated: the table of chunks would be at byte " + std::to_string(at) +
                  ", the file has " + std::to_string(size));
  return static_cast<std::size_t>(at);
}

// Returns whether a file may have a table of chunks. A file without points need not have one.
bool has_table(const InputFile& file, const LasHeader& header) {
  return file.size() >= header.data_offset && file.size() - header.data_offset >= 2 * sizeof(std::int64_t);
}

// Adds chunks until they have all points. The table has more chunks if the header has too few points. Writers
// that stopped early leave 0 points in the header.
void read_chunks(const InputFile& file, LasHeader& header, LazLayout& layout) {
  std::uint32_t used_chunks = 0;
  const std::size_t points = header.cloud.width;
  const std::size_t table = chunk_table_offset(file, header.data_offset);
  std::size_t offset = header.data_offset + sizeof(std::int64_t), done = 0;
  std::uint32_t fixed = value_at<std::uint32_t>(layout.record, 12);
  if (fixed == 0) fixed = kVariablePoints;
  ChunkTableReader entries(file, table, fixed == kVariablePoints);
  // A chunk begins with a point that is not compressed.
  if (entries.size() > (table - offset) / header.record)
    throw IoError("corrupt: " + std::to_string(entries.size()) + " chunks cannot be in " +
                  std::to_string(table - offset) + " bytes");
  for (std::uint32_t i = 0; i < entries.size() && done < points; ++i) {
    const ChunkTableReader::Entry entry = entries.next();
    const std::size_t count = fixed == kVariablePoints ? entry.points : fixed;
    if (entry.bytes > table - offset)
      throw IoError("corrupt: chunk " + std::to_string(i) + " of " + std::to_string(entry.bytes) +
                    " bytes ends behind the table of chunks");
    if (count > 0 && entry.bytes < header.record)
      throw IoError("corrupt: chunk " + std::to_string(i) + " has " + std::to_string(entry.bytes) +
                    " bytes, a point has " + std::to_string(header.record));
    const bool whole = count < points - done || (fixed == kVariablePoints && count == points - done);
    const std::size_t used = std::min(count, points - done);
    if (used > 0) layout.chunks.push_back({offset, entry.bytes, used, whole});
    done += used;
    offset += entry.bytes;
    used_chunks = i + 1;
  }
  std::uint32_t more = 0;
  for (std::uint32_t i = used_chunks; i < entries.size(); ++i)
    more += fixed != kVariablePoints || entries.next().points > 0 ? 1 : 0;
  if (more > 0 && points == 0)
    throw IoError("header: 0 points, but " + std::to_string(more) + " chunks of points follow");
  if (more > 0)
    add_note(header.cloud, "the header says " + std::to_string(points) + " points; " + std::to_string(more) +
                               " more chunks of points follow, which are not read");
  if (done < points)
    throw IoError("truncated: the chunks have " + std::to_string(done) + " points, the header says " +
                  std::to_string(points));
}

}  // namespace

void read_laz_layout(const InputFile& file, LasHeader& header, LazLayout layout) {
  layout.record = find_record(file, header.data_offset);
  check_record(layout, header.record);
  const std::size_t points = header.cloud.width, size = file.size();
  if (points > kMaxPointsPerByte * size)
    throw IoError("corrupt: a file of " + std::to_string(size) + " bytes cannot have " +
                  std::to_string(points) + " points");
  if (points > 0 && layout.compressor == LazLayout::pointwise) {
    if (header.data_offset >= size) throw IoError("truncated: the points are missing");
    layout.chunks.push_back({header.data_offset, size - header.data_offset, points, false});
  } else if (layout.compressor != LazLayout::pointwise && (points > 0 || has_table(file, header))) {
    read_chunks(file, header, layout);
  }
  header.laz = std::move(layout);
}

}  // namespace pcl_bv::detail
