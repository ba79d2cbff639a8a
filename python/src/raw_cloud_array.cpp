// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "raw_cloud_array.h"

#include <set>

#include "arguments.h"
#include "pcl_bv/io/raw_cloud_edit.h"
#include "pcl_bv/io/read_cloud.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

py::dtype type_of(const RawCloud& cloud) {
  py::list names, formats, offsets;
  std::set<std::string> known;
  for (const PointField& field : cloud.fields) {
    if (field.name == "_" || !known.insert(field.name).second) continue;
    const char kind = field.type == 'F' ? 'f' : field.type == 'I' ? 'i' : 'u';
    const py::str element(std::string("<") + kind + std::to_string(field.size));
    names.append(field.name);
    formats.append(field.count == 1 ? py::object(element) : py::make_tuple(element, field.count));
    offsets.append(field.offset);
  }
  return py::dtype(names, formats, offsets, static_cast<py::ssize_t>(cloud.point_step));
}

/// Returns the TYPE letter of a .pcd file for a field's numbers, or 0 for types that a .pcd file cannot hold.
char letter_of(const py::dtype& type) {
  switch (type.kind()) {
    case 'f':
      return type.itemsize() == 4 || type.itemsize() == 8 ? 'F' : '\0';
    case 'i':
      return 'I';
    case 'u':
    case 'b':
      return 'U';
    default:
      return '\0';
  }
}

/// Converts a field of the records to a field of the cloud.
PointField point_field_of(const std::string& name, const py::dtype& type) {
  const py::object shape = type.attr("shape");
  const py::dtype element = py::dtype::from_args(type.attr("base"));
  PointField field;
  field.name = name;
  field.type = letter_of(element);
  if (field.type == 0)
    throw py::type_error("points: a .pcd cannot hold the field '" + name + "' of " +
                         py::str(py::handle(type)).cast<std::string>());
  field.size = static_cast<std::uint32_t>(element.itemsize());
  field.count = static_cast<std::uint32_t>(type.itemsize() / element.itemsize());
  return field;
}

/// Returns a cloud with all fields of the records, packed, in little-endian byte order.
RawCloud cloud_of_records(const py::array& records) {
  const py::array flat = records.attr("reshape")(-1);
  RawCloud cloud;
  cloud.height = records.ndim() == 2 ? static_cast<std::size_t>(records.shape(0)) : 1;
  cloud.width = static_cast<std::size_t>(flat.size()) / std::max<std::size_t>(cloud.height, 1);
  py::list packed;
  for (const py::handle name : records.dtype().attr("names")) {
    const py::tuple found = records.dtype().attr("fields")[name];
    PointField& field =
        cloud.fields.emplace_back(point_field_of(name.cast<std::string>(), py::dtype::from_args(found[0])));
    field.offset = cloud.point_step;
    cloud.point_step += field.bytes();
    packed.append(py::make_tuple(name, found[0].attr("newbyteorder")("<")));
  }
  const py::array copy = flat.attr("astype")(py::dtype::from_args(packed));
  const auto* const begin = static_cast<const std::byte*>(copy.data());
  cloud.data.assign(begin, begin + copy.nbytes());
  update_packed_xyz(cloud);
  return cloud;
}

RawCloud cloud_of_points(const PointView& points) {
  RawCloud cloud;
  const std::size_t size = size_of(points.scalar);
  for (const char* name : {"x", "y", "z"}) {
    PointField& field = cloud.fields.emplace_back();
    field.name = name;
    field.size = static_cast<std::uint32_t>(size);
    field.offset = cloud.point_step;
    cloud.point_step += size;
  }
  cloud.width = points.count;
  cloud.data.resize(points.count * 3 * size);
  for (std::size_t i = 0; i < points.count; ++i)
    std::memcpy(cloud.data.data() + i * 3 * size, points.address(i), 3 * size);
  return cloud;
}

}  // namespace

py::array array_of_cloud(RawCloud&& cloud) {
  auto* const held = new RawCloud(std::move(cloud));
  const py::capsule owner(held, [](void* p) { delete static_cast<RawCloud*>(p); });
  const auto step = static_cast<py::ssize_t>(held->point_step);
  const auto width = static_cast<py::ssize_t>(held->width), height = static_cast<py::ssize_t>(held->height);
  if (held->height > 1)
    return py::array(type_of(*held), {height, width}, {width * step, step}, held->data.data(), owner);
  return py::array(type_of(*held), {width}, {step}, held->data.data(), owner);
}

void write_cloud(const std::filesystem::path& path, py::handle points, py::handle labels) {
  const PointArray array = points_of(points);
  const bool records = !is_masked(points) && py::isinstance<py::array>(points) &&
                       py::reinterpret_borrow<py::array>(points).dtype().has_fields();
  RawCloud cloud =
      records ? cloud_of_records(py::reinterpret_borrow<py::array>(points)) : cloud_of_points(array.view);
  if (!labels.is_none()) set_uint32_field(cloud, "label", point_labels(labels, array.view.count));
  const py::gil_scoped_release unlocked;
  write_pcd(path, cloud);
}

}  // namespace pcl_bv::python
