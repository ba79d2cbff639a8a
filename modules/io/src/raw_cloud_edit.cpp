// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/raw_cloud_edit.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "fields.h"
#include "text.h"

namespace pcl_bv::detail {
namespace {

void check_new_field(const RawCloud& cloud, std::string_view name, std::size_t values) {
  if (!is_word(name) || name == "_" || is_coordinate_name(name)) {
    throw std::invalid_argument("field name '" + std::string(name) +
                                "': must be a word other than _, x, y and z, X, Y and Z");
  }
  if (values != cloud.size()) {
    throw std::invalid_argument("field '" + std::string(name) + "': " + std::to_string(values) +
                                " values, must be one for each of " + std::to_string(cloud.size()) +
                                " points");
  }
}

// Returns the fields including the new one. All other fields still have their old offsets.
std::vector<PointField> fields_with(const RawCloud& cloud, std::string_view name) {
  const auto named = [&](const PointField& field) { return field.name == name; };
  const PointField added{std::string(name), 'U', 4, 1, 0};
  std::vector<PointField> fields = cloud.fields;
  const auto existing_field = std::find_if(fields.begin(), fields.end(), named);
  if (existing_field == fields.end()) {
    fields.push_back(added);
  } else {
    *existing_field = added;
    fields.erase(std::remove_if(existing_field + 1, fields.end(), named), fields.end());
  }
  return fields;
}

template <typename T>
void copy_values(const std::byte* from, std::size_t count, std::size_t step, std::int64_t* to) {
  for (std::size_t i = 0; i < count; ++i, from += step) {
    T stored;
    std::memcpy(&stored, from, sizeof stored);
    to[i] = std::int64_t{stored};  // NOLINT(bugprone-signed-char-misuse): a number of 8 bits, no character
  }
}

}  // namespace

const PointField& integer_field(const RawCloud& cloud, std::string_view name) {
  const auto refuse = [&](const std::string& why) {
    throw std::runtime_error("field '" + std::string(name) + "' " + why);
  };
  const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&](const PointField& one) { return one.name == name; });
  if (field == cloud.fields.end()) {
    std::string names;
    for (const PointField& one : cloud.fields)
      names += (names.empty() ? "" : ", ") + one.name;
    throw std::runtime_error("there is no field '" + std::string(name) + "'; the fields are " + names);
  }
  if (field->type == 'F') refuse("is floating point, not an integer");
  const std::vector<std::string>& invalid = cloud.invalid_fields;
  if (std::find(invalid.begin(), invalid.end(), field->name) != invalid.end())
    refuse("has values that are no integers: " + cloud.note);
  if (field->count != 1) refuse("has " + std::to_string(field->count) + " elements a point, not one");
  if (field->size == 8 && field->type != 'I') refuse("is unsigned with 8 bytes; at most 4 are supported");
  return *field;
}

void copy_integers(const PointField& field, const std::byte* records, std::size_t count,
                   std::size_t point_step, std::int64_t* to) {
  const bool is_signed = field.type == 'I';
  const std::byte* const from = records + field.offset;
  const auto copy = [&](auto if_signed, auto if_unsigned) {
    is_signed ? copy_values<decltype(if_signed)>(from, count, point_step, to)
              : copy_values<decltype(if_unsigned)>(from, count, point_step, to);
  };
  if (field.size == 1) return copy(std::int8_t{}, std::uint8_t{});
  if (field.size == 2) return copy(std::int16_t{}, std::uint16_t{});
  if (field.size == 4) return copy(std::int32_t{}, std::uint32_t{});
  copy_values<std::int64_t>(from, count, point_step, to);
}

std::vector<std::int64_t> integers_of(const RawCloud& cloud, std::string_view name) {
  std::vector<std::int64_t> values(cloud.size());
  copy_integers(integer_field(cloud, name), cloud.data.data(), values.size(), cloud.point_step,
                values.data());
  return values;
}

RawCloud make_cloud(const std::vector<float>& xyz) {
  if (xyz.size() % 3 != 0) {
    throw std::invalid_argument(std::to_string(xyz.size()) + " coordinates, must be a multiple of 3");
  }
  RawCloud cloud;
  cloud.fields = {{"x", 'F', 4, 1, 0}, {"y", 'F', 4, 1, 4}, {"z", 'F', 4, 1, 8}};
  cloud.width = xyz.size() / 3;
  cloud.point_step = 3 * sizeof(float);
  cloud.data.resize(xyz.size() * sizeof(float));
  if (!xyz.empty()) std::memcpy(cloud.data.data(), xyz.data(), cloud.data.size());
  return cloud;
}

void set_uint32_field(RawCloud& cloud, std::string_view name, const std::vector<std::uint32_t>& values) {
  check_new_field(cloud, name, values.size());
  std::vector<PointField> fields = fields_with(cloud, name);
  std::size_t step = 0;
  for (const PointField& field : fields)
    step += field.bytes();

  ByteBuffer data(cloud.size() * step);
  std::size_t offset = 0;
  for (PointField& field : fields) {
    const StridedSource from =
        field.name == name
            ? StridedSource{reinterpret_cast<const std::byte*>(values.data()), 0, sizeof(std::uint32_t)}
            : StridedSource{cloud.data.data(), field.offset, cloud.point_step};
    copy_strided(from, {data.data(), offset, step}, field.bytes(), cloud.size());
    field.offset = offset;
    offset += field.bytes();
  }
  cloud.fields = std::move(fields);
  cloud.point_step = step;
  cloud.data = std::move(data);
  update_packed_xyz(cloud);
}

void update_packed_xyz(RawCloud& cloud) {
  cloud.packed_xyz.clear();
  const CoordinateFields fields = coordinate_fields(cloud.fields);
  if (!fields.readable || fields.adjacent) return;
  cloud.packed_xyz.resize(3 * size_of(fields.scalar) * cloud.size());
  pack_coordinates(fields, cloud.data.data(), cloud.size(), cloud.point_step, cloud.packed_xyz.data());
}

}  // namespace pcl_bv::detail
