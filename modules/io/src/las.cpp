// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// ASPRS LAS Specification 1.4 R15, tables 3 (header) and 7 to 17 (records). All numbers are little-endian.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "las_format.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kHeaderOf12 = 227, kHeaderOf14 = 375;

// What a record holds, by point format.
struct PointFormat {
  std::size_t bytes;                                       // at least; files may add some
  std::size_t time, color;                                 // offsets, 0: none
  bool wide() const { return bytes >= 30 && time == 22; }  // formats 6 to 10
};
constexpr PointFormat kFormats[] = {{20, 0, 0},   {28, 20, 0},  {26, 0, 20}, {34, 20, 28},
                                    {57, 20, 0},  {63, 20, 28}, {30, 22, 0}, {36, 22, 30},
                                    {38, 22, 30}, {59, 22, 0},  {67, 22, 30}};

class HeaderBytes {
 public:
  explicit HeaderBytes(const InputFile& file) : bytes_(std::min(file.size(), kHeaderOf14)) {
    file.read(0, bytes_.data(), bytes_.size());
    if (bytes_.size() < 4 || std::memcmp(bytes_.data(), "LASF", 4) != 0)
      throw IoError("not a .las file: it does not begin with LASF");
    if (bytes_.size() < kHeaderOf12) throw IoError("truncated header");
  }

  template <typename T>
  T at(std::size_t offset) const {
    if (offset + sizeof(T) > bytes_.size()) throw IoError("truncated header");
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }

 private:
  std::vector<std::byte> bytes_;
};

void add_field(const char* name, char type, std::uint32_t size, std::size_t from, LasHeader& header) {
  RawCloud& cloud = header.cloud;
  cloud.fields.push_back({name, type, size, 1, cloud.point_step});
  cloud.point_step += size;
  header.from.push_back(from);
}

void add_fields(const PointFormat& format, LasHeader& header) {
  for (const auto& [name, from] : {std::pair{"x", 0}, {"y", 4}, {"z", 8}})
    add_field(name, 'F', 8, static_cast<std::size_t>(from), header);
  add_field("intensity", 'U', 2, 12, header);
  add_field("returns", 'U', 1, 14, header);
  add_field("classification", 'U', 1, format.wide() ? 16 : 15, header);
  add_field("point_source_id", 'U', 2, format.wide() ? 20 : 18, header);
  if (format.time != 0) add_field("gps_time", 'F', 8, format.time, header);
  if (format.color == 0) return;
  add_field("red", 'U', 2, format.color, header);
  add_field("green", 'U', 2, format.color + 2, header);
  add_field("blue", 'U', 2, format.color + 4, header);
}

const PointFormat& point_format(const HeaderBytes& bytes) {
  const auto format = bytes.at<std::uint8_t>(104);
  if (format >= 128)  // the bits that LASzip sets
    throw IoError("compressed (LAZ) points cannot be read; unpack them first, with laszip or pdal");
  if (format >= std::size(kFormats))
    throw IoError("header: point format " + std::to_string(format) + " is not one of 0 to 10");
  return kFormats[format];
}

// 1.4 has a number of 64 bits; the old one is 0 there for its formats.
std::size_t point_count(const HeaderBytes& bytes, int minor) {
  const auto old = bytes.at<std::uint32_t>(107);
  return minor < 4 ? old : std::max<std::size_t>(old, bytes.at<std::uint64_t>(247));
}

void require_points(const InputFile& file, const LasHeader& header) {
  const std::size_t points = header.cloud.width;
  const bool behind = header.data_offset > file.size();
  if (!behind && points <= (file.size() - header.data_offset) / header.record) return;
  throw IoError("truncated: " + std::to_string(points) + " points of " + std::to_string(header.record) +
                " bytes from byte " + std::to_string(header.data_offset) + " on, the file has " +
                std::to_string(file.size()));
}

}  // namespace

LasHeader read_las_header(const InputFile& file) {
  const HeaderBytes bytes(file);
  const int major = bytes.at<std::uint8_t>(24), minor = bytes.at<std::uint8_t>(25);
  if (major != 1 || minor < 2 || minor > 4)
    throw IoError("header: version " + std::to_string(major) + "." + std::to_string(minor) +
                  " is not one of 1.2 to 1.4");
  LasHeader header;
  const PointFormat& format = point_format(bytes);
  header.data_offset = bytes.at<std::uint32_t>(96);
  header.record = bytes.at<std::uint16_t>(105);
  if (header.record < format.bytes || header.data_offset < kHeaderOf12)
    throw IoError("header: records of " + std::to_string(header.record) + " bytes from byte " +
                  std::to_string(header.data_offset) + " on are too short or in the header");
  header.cloud.width = point_count(bytes, minor);
  require_points(file, header);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = bytes.at<double>(131 + 8 * axis);
    header.offset[axis] = bytes.at<double>(155 + 8 * axis);
    if (!std::isfinite(header.scale[axis]) || header.scale[axis] == 0 || !std::isfinite(header.offset[axis]))
      throw IoError("header: a scale is 0 or not finite, or an offset is not finite");
  }
  add_fields(format, header);
  return header;
}

void read_las_points(const InputFile& file, LasHeader& header) {
  constexpr std::size_t at_a_time = 4096;
  RawCloud& cloud = header.cloud;
  cloud.data.resize(cloud.size() * cloud.point_step);
  std::vector<std::byte> records(std::min(at_a_time, cloud.size()) * header.record);
  std::byte* to = cloud.data.data();
  for (std::size_t first = 0; first < cloud.size(); first += at_a_time) {
    const std::size_t count = std::min(at_a_time, cloud.size() - first);
    file.read(header.data_offset + first * header.record, records.data(), count * header.record);
    for (const std::byte* from = records.data(); from < records.data() + count * header.record;
         from += header.record, to += cloud.point_step) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::int32_t stored;
        std::memcpy(&stored, from + 4 * axis, sizeof stored);
        const double value = stored * header.scale[axis] + header.offset[axis];
        std::memcpy(to + 8 * axis, &value, sizeof value);
      }
      for (std::size_t f = 3; f < cloud.fields.size(); ++f)
        std::memcpy(to + cloud.fields[f].offset, from + header.from[f], cloud.fields[f].size);
    }
  }
}

}  // namespace pcl_bv
