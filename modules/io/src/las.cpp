// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// ASPRS LAS Specification 1.4 R15, tables 3 (header), 7 to 17 (records) and 24 (extended records). All
// numbers are little-endian. Versions 1.0, 1.1 and 1.5 have the fields that are read here at the same
// offsets.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "fields.h"
#include "las_format.h"
#include "trailing_points.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kHeaderOf12 = 227, kHeaderOf14 = 375;
constexpr int kNewestMinor = 5;

// Layout of a record, by point format.
struct PointFormat {
  std::size_t bytes;                                       // minimum; files may have extra bytes
  std::size_t time, color;                                 // offsets; 0 if the format has no such field
  bool wide() const { return bytes >= 30 && time == 22; }  // formats 6 to 10
};
constexpr PointFormat kFormats[] = {{20, 0, 0},   {28, 20, 0},  {26, 0, 20}, {34, 20, 28},
                                    {57, 20, 0},  {63, 20, 28}, {30, 22, 0}, {36, 22, 30},
                                    {38, 22, 30}, {59, 22, 0},  {67, 22, 30}};

// A number of a few bits within a byte. The names are as in laspy and PDAL.
struct PackedField {
  const char* name;
  std::size_t byte;
  unsigned first_bit, bits;
};
constexpr PackedField kPacked[] = {{"return_number", 14, 0, 3},       {"number_of_returns", 14, 3, 3},
                                   {"scan_direction_flag", 14, 6, 1}, {"edge_of_flight_line", 14, 7, 1},
                                   {"classification", 15, 0, 5},      {"synthetic", 15, 5, 1},
                                   {"key_point", 15, 6, 1},           {"withheld", 15, 7, 1}};
constexpr PackedField kWidePacked[] = {
    {"return_number", 14, 0, 4},       {"number_of_returns", 14, 4, 4}, {"scan_direction_flag", 15, 6, 1},
    {"edge_of_flight_line", 15, 7, 1}, {"classification", 16, 0, 8},    {"synthetic", 15, 0, 1},
    {"key_point", 15, 1, 1},           {"withheld", 15, 2, 1},          {"overlap", 15, 3, 1},
    {"scanner_channel", 15, 4, 2}};

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
  if (header.cloud.fields.size() > 3) header.columns.push_back({from, cloud.point_step, size, 0, 0xFF});
  cloud.point_step += size;
}

template <std::size_t n>
void add_packed_fields(const PackedField (&packed)[n], LasHeader& header) {
  for (const auto& [name, byte, first_bit, bits] : packed) {
    add_field(name, 'U', 1, byte, header);
    header.columns.back().shift = first_bit;
    header.columns.back().mask = (1U << bits) - 1;
  }
}

void add_fields(const PointFormat& format, LasHeader& header) {
  for (const auto& [name, from] : {std::pair{"x", 0}, {"y", 4}, {"z", 8}})
    add_field(name, 'F', 8, static_cast<std::size_t>(from), header);
  add_field("intensity", 'U', 2, 12, header);
  format.wide() ? add_packed_fields(kWidePacked, header) : add_packed_fields(kPacked, header);
  add_field("point_source_id", 'U', 2, format.wide() ? 20 : 18, header);
  if (format.time != 0) add_field("gps_time", 'F', 8, format.time, header);
  if (format.color == 0) return;
  add_field("red", 'U', 2, format.color, header);
  add_field("green", 'U', 2, format.color + 2, header);
  add_field("blue", 'U', 2, format.color + 4, header);
}

// LASzip sets the highest bit of the point format.
constexpr unsigned kCompressed = 128;

const PointFormat& point_format(const HeaderBytes& bytes) {
  const unsigned format = bytes.at<std::uint8_t>(104) % kCompressed;
  if (format >= std::size(kFormats))
    throw IoError("header: point format " + std::to_string(format) + " is not one of 0 to 10");
  return kFormats[format];
}

// Throws IoError in builds without LASzip.
bool is_compressed(const HeaderBytes& bytes) {
  if (bytes.at<std::uint8_t>(104) < kCompressed) return false;
  if (!reads_laz())
    throw IoError(
        "compressed (LAZ) points: this build has no LASzip (Debian 13: liblaszip-dev). Decompress the file "
        "with laszip or pdal first");
  return true;
}

LazLayout laz_layout(const PointFormat& format) {
  LazLayout layout;
  layout.point_format = static_cast<unsigned>(&format - kFormats);
  layout.time_at = format.time;
  layout.color_at = format.color;
  return layout;
}

// Returns the number of points. From version 1.4 on, the 64-bit count decides. The legacy count is used only
// if a writer left the 64-bit count 0 and the point format is 0 to 5. The legacy count is not valid for
// formats 6 to 10.
std::size_t point_count(const HeaderBytes& bytes, int minor, const PointFormat& format, RawCloud& cloud) {
  const auto legacy = bytes.at<std::uint32_t>(107);
  if (minor < 4) return legacy;
  const auto count = bytes.at<std::uint64_t>(247);
  if (legacy == 0 || legacy == count) return count;
  const bool use_legacy = count == 0 && !format.wide();
  add_note(cloud, "the header has a legacy count of " + std::to_string(legacy) +
                      " points and a 64-bit count of " + std::to_string(count) + "; the " +
                      (use_legacy ? "legacy" : "64-bit") + " count is used");
  return use_legacy ? legacy : count;
}

// Returns whether an extended variable length record that begins at `at` fits in the file.
bool is_extended_record(const InputFile& file, std::size_t at) {
  constexpr std::size_t header = 60, length = 20;
  if (at > file.size() || file.size() - at < header) return false;
  std::uint64_t bytes = 0;
  file.read(at + length, &bytes, sizeof bytes);
  return bytes <= file.size() - at - header;
}

// Returns an upper limit for the end of the point data. The limit is the start of the extended records behind
// the points (waveforms or other data), or the end of the file if there are none.
std::size_t end_of_point_data(const InputFile& file, const HeaderBytes& bytes, int minor, std::size_t begin) {
  std::size_t end = file.size();
  const auto stop_at = [&](std::size_t at) {
    if (at > begin && at < end && is_extended_record(file, at)) end = at;
  };
  if (minor >= 3) stop_at(bytes.at<std::uint64_t>(227));
  if (minor >= 4 && bytes.at<std::uint32_t>(243) > 0) stop_at(bytes.at<std::uint64_t>(235));
  return end;
}

void require_points(const InputFile& file, std::size_t end, LasHeader& header) {
  const std::size_t points = header.cloud.width, begin = header.data_offset;
  if (begin <= end && points <= (end - begin) / header.record)
    return note_trailing_points(file, {begin + points * header.record, end}, header.record, header.cloud);
  const std::string what = std::to_string(points) + " points of " + std::to_string(header.record) +
                           " bytes from byte " + std::to_string(begin) + " on, ";
  if (end < file.size())
    throw IoError("header: " + what + "but other records begin at byte " + std::to_string(end));
  throw IoError("truncated: " + what + "the file has " + std::to_string(end));
}

void read_scale(const HeaderBytes& bytes, LasHeader& header) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = bytes.at<double>(131 + 8 * axis);
    header.offset[axis] = bytes.at<double>(155 + 8 * axis);
    if (!std::isfinite(header.scale[axis]) || header.scale[axis] == 0 || !std::isfinite(header.offset[axis]))
      throw IoError("header: a scale is 0 or not finite, or an offset is not finite");
  }
}

}  // namespace

void convert_las_record(const std::byte* from, const LasHeader& header, std::byte* to) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int32_t stored;
    std::memcpy(&stored, from + 4 * axis, sizeof stored);
    const double value = stored * header.scale[axis] + header.offset[axis];
    std::memcpy(to + 8 * axis, &value, sizeof value);
  }
  for (const LasColumn& column : header.columns) {
    const std::byte* const at = from + column.from;
    if (column.size == 1) {
      to[column.to] = at[0] >> column.shift & static_cast<std::byte>(column.mask);
    } else if (column.size == 2) {
      std::memcpy(to + column.to, at, 2);
    } else {
      std::memcpy(to + column.to, at, 8);
    }
  }
}

LasHeader read_las_header(const InputFile& file) {
  const HeaderBytes bytes(file);
  const int major = bytes.at<std::uint8_t>(24), minor = bytes.at<std::uint8_t>(25);
  if (major != 1 || minor > kNewestMinor)
    throw IoError("header: version " + std::to_string(major) + "." + std::to_string(minor) +
                  " is not one of 1.0 to 1." + std::to_string(kNewestMinor));
  LasHeader header;
  const PointFormat& format = point_format(bytes);
  header.data_offset = bytes.at<std::uint32_t>(96);
  header.record = bytes.at<std::uint16_t>(105);
  if (header.record < format.bytes || header.data_offset < kHeaderOf12)
    throw IoError("header: record size " + std::to_string(header.record) +
                  " is too small for the point format, or the point data offset " +
                  std::to_string(header.data_offset) + " is inside the header");
  header.cloud.width = point_count(bytes, minor, format, header.cloud);
  if (is_compressed(bytes)) {
    read_laz_layout(file, header, laz_layout(format));
  } else {
    require_points(file, end_of_point_data(file, bytes, minor, header.data_offset), header);
  }
  read_scale(bytes, header);
  add_fields(format, header);
  const std::string units = las_units_note(file, bytes.at<std::uint16_t>(94), header.data_offset);
  if (!units.empty()) add_note(header.cloud, units);
  return header;
}

void read_las_points(const InputFile& file, LasHeader& header, const ParallelPolicy& policy) {
  if (header.laz) return read_laz_points(file, header, policy);
  constexpr std::size_t at_a_time = 4096;
  RawCloud& cloud = header.cloud;
  cloud.data.resize(cloud.size() * cloud.point_step);
  std::vector<std::byte> records(std::min(at_a_time, cloud.size()) * header.record);
  std::byte* to = cloud.data.data();
  for (std::size_t first = 0; first < cloud.size(); first += at_a_time) {
    const std::size_t count = std::min(at_a_time, cloud.size() - first);
    file.read(header.data_offset + first * header.record, records.data(), count * header.record);
    for (std::size_t i = 0; i < count; ++i, to += cloud.point_step)
      convert_las_record(records.data() + i * header.record, header, to);
  }
}

}  // namespace pcl_bv::detail
