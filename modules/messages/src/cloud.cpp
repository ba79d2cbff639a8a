// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/messages/cloud.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>
#include <utility>

#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/messages/serialize.h"

namespace pcl_bv::detail {
namespace {

struct Datatype {
  char type;
  std::uint32_t size;
};

// Types of fields. The index is the datatype of sensor_msgs/PointField minus 1.
constexpr Datatype kDatatypes[]{{'I', 1}, {'U', 1}, {'I', 2}, {'U', 2},
                                {'I', 4}, {'U', 4}, {'F', 4}, {'F', 8}};

[[noreturn]] void refuse(const std::string& what) {
  throw MessageError("the cloud " + what);
}

// Positions of the points in the data.
struct Layout {
  std::size_t width = 0, height = 0;
  std::uint64_t row_bytes = 0;  // bytes from one row to the next

  std::size_t points() const { return width * height; }
};

// Returns the positions of the points. If the data has exactly the bytes that the points need, two errors of
// drivers are ignored: height 0 for an unorganised cloud, and a wrong row_step.
Layout layout_of(const msg::PointCloud2& cloud) {
  const std::uint64_t width = cloud.width, step = cloud.point_step, size = cloud.data.size;
  const std::uint64_t packed = width * step;  // below 2^64
  const std::uint64_t height = cloud.height == 0 && packed > 0 && packed == size ? 1 : cloud.height;
  if (width == 0 || height == 0) return {};
  const std::string shape = std::to_string(width) + " x " + std::to_string(height) + " points of " +
                            std::to_string(step) + " bytes";
  if (step == 0) refuse("has " + shape);
  if (size / packed < height)
    refuse("should have " + shape + ", but has only " + std::to_string(size) + " bytes");
  const auto fits = [&](std::uint64_t row) { return row >= packed && height - 1 <= (size - packed) / row; };
  const bool exact = size % packed == 0 && size / packed == height;
  if (height > 1 && !exact && !fits(cloud.row_step))
    refuse("has a row_step of " + std::to_string(cloud.row_step) + " for " + shape + " in " +
           std::to_string(size) + " bytes; without padding a row has " + std::to_string(packed));
  return {width, height, height == 1 || exact ? packed : cloud.row_step};
}

// Returns the problem of a field, which is that the type is unknown or that the field exceeds the record.
// Returns an empty text for a valid field.
std::string problem_of(const msg::PointField& field, std::uint32_t count, std::uint32_t point_step) {
  if (field.datatype < 1 || field.datatype > std::size(kDatatypes))
    return "is of datatype " + std::to_string(field.datatype) + ", not 1 to 8";
  const std::uint64_t bytes = std::uint64_t{count} * kDatatypes[field.datatype - 1].size;
  if (field.offset > point_step || bytes > point_step - field.offset)
    return "exceeds the point_step of " + std::to_string(point_step) + " bytes";
  return {};
}

using Coordinates3 = std::array<const msg::PointField*, 3>;

// Finds the fields x, y and z. If one is missing, X, Y or Z is used instead, because some writers use these
// names. Throws MessageError if a coordinate is missing or its field is invalid.
Coordinates3 coordinates_of(const msg::PointCloud2& cloud) {
  Coordinates3 found{};
  const auto named = [&](const char* name) -> const msg::PointField* {
    const auto at = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                 [&](const msg::PointField& field) { return field.name == name; });
    return at == cloud.fields.end() ? nullptr : &*at;
  };
  constexpr const char *lower[] = {"x", "y", "z"}, *upper[] = {"X", "Y", "Z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    found[axis] = named(lower[axis]);
    if (found[axis] == nullptr) found[axis] = named(upper[axis]);
    if (found[axis] == nullptr) {
      std::string names;
      for (const msg::PointField& field : cloud.fields)
        names += (names.empty() ? "" : ", ") + field.name;
      refuse(std::string("has no field ") + lower[axis] +
             (names.empty() ? "" : ", its fields are " + in_quotes(names)));
    }
    const std::string problem = problem_of(*found[axis], 1, cloud.point_step);
    if (!problem.empty()) refuse("has a field " + in_quotes(found[axis]->name) + " that " + problem);
  }
  return found;
}

PointField element_of(const msg::PointField& field, std::string name, std::uint32_t count) {
  const auto [type, size] = kDatatypes[field.datatype - 1];
  return {std::move(name), type, size, count, field.offset};
}

// A field of the message's record, and the field of the new record to which it is converted.
struct FieldConversion {
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

void copy_element(const std::byte* from, bool swap, const FieldConversion& conversion, std::byte* to) {
  std::byte bytes[8];
  std::memcpy(bytes, from, conversion.from.size);
  if (swap) std::reverse(bytes, bytes + conversion.from.size);
  if (conversion.from.type == conversion.to.type && conversion.from.size == conversion.to.size) {
    std::memcpy(to, bytes, conversion.to.size);
  } else if (const double value = number_at(bytes, conversion.from); conversion.to.size == 8) {
    std::memcpy(to, &value, 8);
  } else {
    const auto narrow = static_cast<float>(value);
    std::memcpy(to, &narrow, 4);
  }
}

// Returns the size of a coordinate in the new record. It is 4 if float32 represents all values of the three
// types exactly, else 8.
std::uint32_t coordinate_size(const Coordinates3& xyz) {
  const bool wide = std::any_of(xyz.begin(), xyz.end(), [](const msg::PointField* field) {
    const auto [type, size] = kDatatypes[field->datatype - 1];
    return type == 'F' ? size == 8 : size == 4;
  });
  return wide ? 8 : 4;
}

// The fields that can be read, and a note about all other fields.
struct Selection {
  std::vector<FieldConversion> conversions;
  std::string note;
  std::size_t left_out = 0;

  void leave_out(const msg::PointField& field, const std::string& problem) {
    constexpr std::size_t max_named = 3;  // fields that the note names
    if (++left_out <= max_named)
      note += (note.empty() ? "" : "; ") + ("field " + in_quotes(field.name)) + " is left out: it " + problem;
    if (left_out == max_named + 1) note += "; and others";
  }
};

// Returns whether the data could have more points than the message says.
bool has_more_data(const msg::PointCloud2& cloud) {
  const Layout layout = layout_of(cloud);
  if (layout.points() == 0) return false;
  const std::uint64_t rows = layout.height, size = cloud.data.size;
  std::uint64_t row = layout.row_bytes;
  if (cloud.row_step > row && cloud.row_step <= size / rows)
    row = cloud.row_step;  // padding after the last row
  return size >= cloud.point_step + rows * row;
}

Selection select_fields(const msg::PointCloud2& cloud, const Coordinates3& xyz) {
  Selection selection;
  if (has_more_data(cloud))
    selection.note = "the data has more bytes than the points need; they are not read";
  // Limits the new record to twice the size of the old record. Fields may overlap, because a colour often has
  // two names. Without a limit, each field of a damaged message could repeat the whole record.
  const std::size_t max_bytes = 2 * std::size_t{cloud.point_step};
  const std::uint32_t size = coordinate_size(xyz);
  std::size_t bytes = 0, offset = 0;
  for (const msg::PointField* const field : xyz)
    bytes += kDatatypes[field->datatype - 1].size;
  for (const msg::PointField& field : cloud.fields) {
    const auto axis = static_cast<std::size_t>(std::find(xyz.begin(), xyz.end(), &field) - xyz.begin());
    const bool coordinate = axis < xyz.size();
    const std::uint32_t count = coordinate ? 1 : std::max(field.count, 1U);
    std::string problem = problem_of(field, count, cloud.point_step);
    if (!coordinate && problem.empty()) {
      const std::size_t own = std::size_t{count} * kDatatypes[field.datatype - 1].size;
      if (field.name == "x" || field.name == "y" || field.name == "z") {
        problem = "occurs twice";
      } else if (bytes + own > max_bytes) {
        problem = "would make the fields longer than two records";
      } else {
        bytes += own;
      }
    }
    if (!problem.empty()) {
      selection.leave_out(field, problem);
      continue;
    }
    const bool named = !field.name.empty() && field.name.find_first_of(" \t\n\v\f\r") == std::string::npos;
    const PointField from = element_of(field,
                                       coordinate ? std::string(1, "xyz"[axis])
                                       : named    ? field.name
                                                  : "_",
                                       count);
    PointField to = from;
    if (coordinate) std::tie(to.type, to.size) = std::pair('F', size);
    to.offset = offset;
    offset += to.bytes();
    selection.conversions.push_back({from, to});
  }
  return selection;
}

void set_fields(RawCloud& cloud, const std::vector<FieldConversion>& conversions) {
  cloud.fields.clear();
  cloud.point_step = 0;
  for (const FieldConversion& conversion : conversions) {
    cloud.fields.push_back(conversion.to);
    cloud.point_step += conversion.to.bytes();
  }
}

// Returns a cloud without points. The message may have no fields, because filters that remove all points
// often publish a cloud without fields.
RawCloud cloud_without_points(const msg::PointCloud2& cloud) {
  RawCloud made = make_cloud({});
  try {
    set_fields(made, select_fields(cloud, coordinates_of(cloud)).conversions);
  } catch (const MessageError&) {  // keep x, y and z as float32
  }
  return made;
}

}  // namespace

std::optional<PointView> view_points(const msg::PointCloud2& cloud) {
  const Layout layout = layout_of(cloud);
  if (layout.points() == 0) return PointView();
  const auto [x, y, z] = coordinates_of(cloud);
  const auto [type, size] = kDatatypes[x->datatype - 1];
  const bool floats = type == 'F' && x->datatype == y->datatype && x->datatype == z->datatype;
  const bool side_by_side =
      std::uint64_t{x->offset} + size == y->offset && std::uint64_t{y->offset} + size == z->offset;
  const bool rows = layout.row_bytes == std::uint64_t{layout.width} * cloud.point_step;
  if (!floats || !side_by_side || !rows || cloud.is_bigendian) return std::nullopt;
  PointView view;
  view.data = cloud.data.data + x->offset;
  view.stride = cloud.point_step;
  view.readable = cloud.point_step - x->offset;
  view.count = layout.points();
  view.scalar = size == 8 ? ScalarType::float64 : ScalarType::float32;
  return view;
}

std::string skipped_fields_note(const msg::PointCloud2& cloud) {
  if (layout_of(cloud).points() == 0) return {};
  return select_fields(cloud, coordinates_of(cloud)).note;
}

namespace {

// Returns find(fields, records, point_step) for the fields of the message.
template <typename Find>
std::optional<FieldView> view_field(const msg::PointCloud2& cloud, const Find& find) {
  if (!view_points(cloud) || cloud.is_bigendian) return std::nullopt;
  std::vector<PointField> fields;
  for (const msg::PointField& field : cloud.fields) {
    if (field.datatype < 1 || field.datatype > std::size(kDatatypes)) continue;
    const auto [type, size] = kDatatypes[field.datatype - 1];
    fields.push_back({field.name, type, size, std::max(field.count, 1U), field.offset});
  }
  return find(fields, cloud.data.data, cloud.point_step);
}

}  // namespace

std::optional<FieldView> view_intensity(const msg::PointCloud2& cloud) {
  return view_field(cloud, intensity_of);
}

std::optional<FieldView> view_times(const msg::PointCloud2& cloud) {
  return view_field(cloud, times_of);
}

RawCloud raw_cloud_of(const msg::PointCloud2& cloud) {
  const Layout layout = layout_of(cloud);
  const std::size_t points = layout.points();
  if (points == 0) return cloud_without_points(cloud);
  const Selection selection = select_fields(cloud, coordinates_of(cloud));
  RawCloud made;
  made.note = selection.note;
  made.width = layout.width;
  made.height = layout.height;
  set_fields(made, selection.conversions);
  made.data.resize(points * made.point_step);
  std::byte* to = made.data.data();
  for (std::size_t i = 0; i < points; ++i, to += made.point_step) {
    const std::byte* const record =
        cloud.data.data + i / layout.width * layout.row_bytes + i % layout.width * cloud.point_step;
    for (const FieldConversion& conversion : selection.conversions) {
      for (std::uint32_t k = 0; k < conversion.from.count; ++k)
        copy_element(record + conversion.from.offset + std::size_t{k} * conversion.from.size,
                     cloud.is_bigendian, conversion,
                     to + conversion.to.offset + std::size_t{k} * conversion.to.size);
    }
  }
  update_packed_xyz(made);
  return made;
}

}  // namespace pcl_bv::detail
