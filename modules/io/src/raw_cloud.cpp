// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/io/raw_cloud.h"

#include <cstring>
#include <stdexcept>

#include "fields.h"

namespace pcl_bv {
using namespace detail;

const PointField* find_field(const RawCloud& cloud, std::string_view name) {
  return find_field(cloud.fields, name);
}

PointView view_of_fields(const std::byte* data, std::size_t count, std::size_t point_step,
                         const std::vector<PointField>& fields) {
  check_coordinates<std::invalid_argument>(fields);
  const CoordinateFields xyz = coordinate_fields(fields);
  if (!xyz.adjacent)
    throw std::invalid_argument(
        "fields x, y and z are not all float32 or all float64, side by side in this order");
  if (point_step < 3 * size_of(xyz.scalar) || xyz.offset[0] > point_step - 3 * size_of(xyz.scalar))
    throw std::invalid_argument("fields x, y and z exceed the point_step of " + std::to_string(point_step) +
                                " bytes");
  if (count > 0 && data == nullptr) throw std::invalid_argument("points without data");
  return count > 0 ? view_at(xyz, data, count, point_step) : PointView();
}

namespace {

template <typename Number>
Number number_in(const FieldView& view, std::size_t record) {
  const std::byte* const from = view.data + record * view.stride;
  return with_element_type({{}, view.type, view.size}, [from](auto value) {
    std::memcpy(&value, from, sizeof value);
    return static_cast<Number>(value);
  });
}

std::optional<FieldView> first_of(std::initializer_list<const char*> names,
                                  const std::vector<PointField>& fields, const std::byte* records,
                                  std::size_t point_step) {
  for (const char* const name : names) {
    const PointField* const field = find_field(fields, name);
    const bool known = field != nullptr && field->count == 1 && (field->type != 'F' || field->size >= 4);
    if (known && field->offset + field->bytes() <= point_step)
      return FieldView{records + field->offset, point_step, field->type, field->size};
  }
  return std::nullopt;
}

}  // namespace

float FieldView::at(std::size_t record) const {
  return number_in<float>(*this, record);
}

double FieldView::number(std::size_t record) const {
  return number_in<double>(*this, record);
}

std::optional<FieldView> intensity_of(const std::vector<PointField>& fields, const std::byte* records,
                                      std::size_t point_step) {
  return first_of({"intensity", "Intensity", "INTENSITY", "intensities", "reflectivity", "i"}, fields,
                  records, point_step);
}

std::optional<FieldView> times_of(const std::vector<PointField>& fields, const std::byte* records,
                                  std::size_t point_step) {
  return first_of({"t", "time", "timestamp", "time_stamp", "offset_time", "time_ns"}, fields, records,
                  point_step);
}

PointView RawCloud::xyz() const {
  const CoordinateFields in = coordinate_fields(fields);
  if (size() == 0 || !in.readable) return {};
  if (in.adjacent) return view_at(in, data.data(), size(), point_step);
  return packed_points(packed_xyz.data(), in.scalar, packed_xyz.size() / (3 * size_of(in.scalar)));
}

}  // namespace pcl_bv
