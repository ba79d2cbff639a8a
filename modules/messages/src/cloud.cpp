// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/messages/cloud.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#include "pcl_bv/io/io_error.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv {
namespace {

struct Datatype {
  char type;
  std::uint32_t size;
};

// By sensor_msgs/PointField's numbers, less one.
constexpr Datatype kDatatypes[]{{'I', 1}, {'U', 1}, {'I', 2}, {'U', 2},
                                {'I', 4}, {'U', 4}, {'F', 4}, {'F', 8}};

[[noreturn]] void refuse(const std::string& what) {
  throw MessageError("the cloud " + what);
}

std::size_t checked_size(const msg::PointCloud2& cloud) {
  const std::uint64_t width = cloud.width, height = cloud.height, step = cloud.point_step;
  if (width == 0 || height == 0) return 0;
  const std::string shape = std::to_string(width) + " x " + std::to_string(height) + " points of " +
                            std::to_string(step) + " bytes";
  if (step == 0) refuse("has " + shape);
  const std::uint64_t row = height > 1 ? cloud.row_step : width * step;
  if (row < width * step) refuse("has rows of " + std::to_string(row) + " bytes for " + shape);
  // Below 2^64: (2^32 - 1)^2 + 2^64 / 2 of one row would not be, but is more than any data.
  const std::uint64_t before_last = (height - 1) * row;
  if (before_last > cloud.data.size || width * step > cloud.data.size - before_last)
    refuse("announces " + shape + ", but has " + std::to_string(cloud.data.size) + " bytes");
  return width * height;
}

const msg::PointField& field_named(const msg::PointCloud2& cloud, const char* name) {
  const auto& fields = cloud.fields;
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const msg::PointField& field) { return field.name == name; });
  if (found == fields.end()) refuse(std::string("has no field ") + name);
  return *found;
}

// One that reaches out of the record, or is of no type, is a mistake of its writer.
PointField checked_field(const msg::PointField& field, std::uint32_t point_step) {
  const std::string name = "has a field " + in_quotes(field.name) + " ";
  if (field.datatype < 1 || field.datatype > std::size(kDatatypes))
    refuse(name + "of datatype " + std::to_string(field.datatype) + ", not 1 to 8");
  const auto [type, size] = kDatatypes[field.datatype - 1];
  const bool named = !field.name.empty() && field.name.find_first_of(" \t\n\v\f\r") == std::string::npos;
  PointField checked{named ? field.name : "_", type, size, std::max(field.count, 1U), field.offset};
  if (field.offset > point_step || std::uint64_t{checked.count} * size > point_step - field.offset)
    refuse(name + "that reaches beyond the point_step of " + std::to_string(point_step));
  return checked;
}

bool is_coordinate(const PointField& field) {
  return field.name == "x" || field.name == "y" || field.name == "z";
}

// Where a field lies in the message's record and how it becomes one of ours.
struct Move {
  PointField from, to;
};

double number_at(const std::byte* bytes, const PointField& field) {
  const auto as = [&](auto zero) {
    std::memcpy(&zero, bytes, sizeof zero);
    return static_cast<double>(zero);
  };
  if (field.type == 'F') return field.size == 8 ? as(0.0) : as(0.F);
  if (field.type == 'I')
    return field.size == 1 ? as(std::int8_t{}) : field.size == 2 ? as(std::int16_t{}) : as(std::int32_t{});
  return field.size == 1 ? as(std::uint8_t{}) : field.size == 2 ? as(std::uint16_t{}) : as(std::uint32_t{});
}

void copy_element(const std::byte* from, bool swap, const Move& move, std::byte* to) {
  std::byte bytes[8];
  std::memcpy(bytes, from, move.from.size);
  if (swap) std::reverse(bytes, bytes + move.from.size);
  if (move.from.type == move.to.type && move.from.size == move.to.size) {
    std::memcpy(to, bytes, move.to.size);
  } else if (const double value = number_at(bytes, move.from); move.to.size == 8) {
    std::memcpy(to, &value, 8);
  } else {
    const auto narrow = static_cast<float>(value);
    std::memcpy(to, &narrow, 4);
  }
}

// What coordinates become: 4 if float32 holds each, else 8.
std::uint32_t coordinate_size(const std::vector<Move>& moves) {
  std::uint32_t size = 4;
  for (const auto& [from, to] : moves) {
    if (is_coordinate(from) && (from.type == 'F' ? from.size == 8 : from.size == 4)) size = 8;
  }
  return size;
}

std::vector<Move> moves_of(const msg::PointCloud2& cloud) {
  std::vector<Move> moves;
  for (const msg::PointField& field : cloud.fields) {
    const PointField from = checked_field(field, cloud.point_step);
    if (is_coordinate(from) && from.count != 1) refuse("has several " + from.name + " a point");
    moves.push_back({from, from});
  }
  // Colours often stand in one place under two names; more than that is no record of points, and would be
  // long.
  std::size_t bytes = 0;
  for (const Move& move : moves)
    bytes += move.from.bytes();
  if (bytes > 2 * std::size_t{cloud.point_step}) refuse("has fields of more bytes than two of its records");
  const std::uint32_t size = coordinate_size(moves);
  std::size_t offset = 0;
  for (auto& [from, to] : moves) {
    if (is_coordinate(from)) std::tie(to.type, to.size) = std::pair('F', size);
    to.offset = offset;
    offset += to.bytes();
  }
  return moves;
}

}  // namespace

std::optional<PointView> points_in_place(const msg::PointCloud2& cloud) {
  const std::size_t points = checked_size(cloud);
  const msg::PointField &x = field_named(cloud, "x"), &y = field_named(cloud, "y"),
                        &z = field_named(cloud, "z");
  const PointField first = checked_field(x, cloud.point_step);
  checked_field(y, cloud.point_step);
  checked_field(z, cloud.point_step);
  const bool floats = first.type == 'F' && x.datatype == y.datatype && x.datatype == z.datatype;
  const bool side_by_side =
      std::uint64_t{x.offset} + first.size == y.offset && std::uint64_t{y.offset} + first.size == z.offset;
  const bool rows = cloud.height <= 1 || cloud.row_step == std::uint64_t{cloud.width} * cloud.point_step;
  if (!floats || !side_by_side || !rows || (cloud.is_bigendian && points > 0)) return std::nullopt;
  if (points == 0) return PointView();
  PointView view;
  view.data = cloud.data.data + x.offset;
  view.stride = cloud.point_step;
  view.readable = cloud.point_step - x.offset;
  view.count = points;
  view.scalar = first.size == 8 ? ScalarType::float64 : ScalarType::float32;
  return view;
}

std::optional<FieldView> intensity_in_place(const msg::PointCloud2& cloud) {
  if (!points_in_place(cloud) || cloud.is_bigendian) return std::nullopt;
  std::vector<PointField> fields;
  for (const msg::PointField& field : cloud.fields) {
    if (field.datatype < 1 || field.datatype > std::size(kDatatypes)) continue;
    const auto [type, size] = kDatatypes[field.datatype - 1];
    fields.push_back({field.name, type, size, std::max(field.count, 1U), field.offset});
  }
  return intensity_of(fields, cloud.data.data, cloud.point_step);
}

RawCloud raw_cloud_of(const msg::PointCloud2& cloud) {
  const std::size_t points = checked_size(cloud);
  for (const char* name : {"x", "y", "z"})
    field_named(cloud, name);
  const std::vector<Move> moves = moves_of(cloud);
  RawCloud made;
  made.width = points > 0 ? cloud.width : 0;
  made.height = points > 0 ? cloud.height : 1;
  for (const Move& move : moves) {
    made.fields.push_back(move.to);
    made.point_step += move.to.bytes();
  }
  made.data.resize(points * made.point_step);
  std::byte* to = made.data.data();
  for (std::size_t i = 0; i < points; ++i, to += made.point_step) {
    const std::byte* const record = cloud.data.data +
                                    i / cloud.width * (cloud.height > 1 ? cloud.row_step : 0) +
                                    i % cloud.width * cloud.point_step;
    for (const Move& move : moves) {
      for (std::uint32_t k = 0; k < move.from.count; ++k)
        copy_element(record + move.from.offset + std::size_t{k} * move.from.size, cloud.is_bigendian, move,
                     to + move.to.offset + std::size_t{k} * move.to.size);
    }
  }
  update_packed_xyz(made);
  return made;
}

}  // namespace pcl_bv
