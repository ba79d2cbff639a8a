// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "arrays.h"

#include "arguments.h"

namespace pcl_bv::python {
namespace {

bool is_real(const py::dtype& type) {
  return type.kind() == 'f' && (type.itemsize() == 4 || type.itemsize() == 8);
}

/// Of numpy's marks '=' (this machine's), '|' (of one byte), '<' and '>'.
bool is_native(const py::dtype& type) {
  return type.byteorder() == '=' || type.byteorder() == '|';
}

[[noreturn]] void refuse_numbers(const char* name, const py::dtype& type) {
  throw py::type_error(std::string(name) + ": float32 or float64 is wanted, not " +
                       py::str(py::handle(type)).cast<std::string>() + ": give array.astype(numpy.float64)");
}

[[noreturn]] void refuse_shape(const char* name, const py::array& array) {
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    shape += (i == 0 ? "" : ", ") + std::to_string(array.shape(i));
  throw py::value_error(std::string(name) + ": the shape (" + shape + (array.ndim() == 1 ? ",)" : ")") +
                        " is not (N, 3 or more) or (H, W, 3 or more)");
}

py::array from_any(py::handle object, const char* name) {
  py::array array = py::reinterpret_steal<py::array>(
      py::detail::npy_api::get().PyArray_FromAny_(object.ptr(), nullptr, 0, 0, 0, nullptr));
  if (array) return array;
  PyErr_Clear();
  refuse_type(name, "an array", object);
}

/// `columns` doubles or floats in each row, packed.
PointArray packed(py::array array) {
  PointArray points;
  const auto count = static_cast<std::size_t>(array.shape(0));
  points.view = packed_points(static_cast<const std::byte*>(array.data()),
                              array.itemsize() == 4 ? ScalarType::float32 : ScalarType::float64, count);
  points.owner = std::move(array);
  return points;
}

PointArray copied(const py::array& rows) {
  const py::object xyz = rows[py::make_tuple(py::ellipsis(), py::slice(0, 3, 1))];
  if (rows.itemsize() == 4) return packed(py::array_t<float, py::array::c_style | py::array::forcecast>(xyz));
  return packed(py::array_t<double, py::array::c_style | py::array::forcecast>(xyz));
}

/// Of (N, 3 or more).
PointArray rows_of(const py::array& array) {
  const py::dtype type = array.dtype();
  const auto size = static_cast<std::size_t>(type.itemsize());
  const auto count = static_cast<std::size_t>(array.shape(0));
  const auto row = static_cast<std::size_t>(array.shape(1)) * size;  // bytes that belong to each point
  const py::ssize_t stride = count > 1 ? array.strides(0) : static_cast<py::ssize_t>(row);
  const bool side_by_side = array.strides(1) == static_cast<py::ssize_t>(size);
  if (!is_native(type) || !side_by_side || stride < static_cast<py::ssize_t>(3 * size)) return copied(array);
  PointArray points{array, {}};
  if (count == 0) return points;
  points.view.data = static_cast<const std::byte*>(array.data());
  points.view.stride = static_cast<std::size_t>(stride);
  points.view.readable = std::min(row, points.view.stride);
  points.view.count = count;
  points.view.scalar = size == 4 ? ScalarType::float32 : ScalarType::float64;
  return points;
}

/// The type of a field and where it is in its record.
struct Field {
  std::string name;
  py::dtype type;
  py::ssize_t offset;
};

/// In upper case where there is none in lower case, as in files.
Field field_of(const py::dtype& record, const char* field, const char* name) {
  const py::object fields = record.attr("fields");
  const std::string upper(1, static_cast<char>(field[0] - 'a' + 'A'));
  const std::string in_record = fields.contains(field) ? field : upper;
  if (!fields.contains(in_record))
    throw py::type_error(std::string(name) + ": records without a field '" + field + "': " + shown(record));
  const py::tuple found = fields[py::str(in_record)];
  return {in_record, py::dtype::from_args(found[0]), found[1].cast<py::ssize_t>()};
}

/// Whether float32 holds all its numbers.
bool fits_float32(const py::dtype& type) {
  return type.kind() == 'f' ? type.itemsize() == 4 : type.itemsize() <= 2;
}

/// Of records in one row.
PointArray records_of(const py::array& array, const char* name) {
  const py::dtype record = array.dtype();
  const Field x = field_of(record, "x", name), y = field_of(record, "y", name),
              z = field_of(record, "z", name);
  for (const Field* field : {&x, &y, &z}) {
    const bool whole =
        (field->type.kind() == 'i' || field->type.kind() == 'u') && field->type.itemsize() <= 4;
    if (!is_real(field->type) && !whole) refuse_numbers(name, field->type);
  }
  const py::ssize_t size = x.type.itemsize();
  const auto count = static_cast<std::size_t>(array.shape(0));
  const py::ssize_t stride = count > 1 ? array.strides(0) : record.itemsize();
  const bool real = is_real(x.type) && is_real(y.type) && is_real(z.type);
  const bool side_by_side = real && y.type.itemsize() == size && z.type.itemsize() == size &&
                            y.offset == x.offset + size && z.offset == y.offset + size;
  const bool native = is_native(x.type) && is_native(y.type) && is_native(z.type);
  if (!side_by_side || !native || stride < 3 * size) {
    const bool wide = !fits_float32(x.type) || !fits_float32(y.type) || !fits_float32(z.type);
    py::array xyz(wide ? py::dtype::of<double>() : py::dtype::of<float>(),
                  std::vector<py::ssize_t>{array.shape(0), 3});
    for (py::ssize_t k = 0; k < 3; ++k) {
      const Field* const fields[] = {&x, &y, &z};
      xyz[py::make_tuple(py::ellipsis(), k)] = array[py::str(fields[k]->name)];
    }
    return packed(xyz);
  }
  PointArray points{array, {}};
  if (count == 0) return points;
  points.view.data = static_cast<const std::byte*>(array.data()) + x.offset;
  points.view.stride = static_cast<std::size_t>(stride);
  points.view.readable = static_cast<std::size_t>(std::min(record.itemsize() - x.offset, stride));
  points.view.count = count;
  points.view.scalar = size == 4 ? ScalarType::float32 : ScalarType::float64;
  return points;
}

}  // namespace

PointArray points_of(py::handle object, const char* name) {
  py::array array =
      py::isinstance<py::array>(object) ? py::reinterpret_borrow<py::array>(object) : from_any(object, name);
  const py::dtype type = array.dtype();
  if (type.has_fields())
    return records_of(array.ndim() == 1 ? array : py::array(array.attr("reshape")(-1)), name);
  if (!is_real(type)) refuse_numbers(name, type);
  if (array.ndim() == 3 && array.shape(2) >= 3)
    array = array.attr("reshape")(py::make_tuple(array.shape(0) * array.shape(1), array.shape(2)));
  if (array.ndim() != 2 || array.shape(1) < 3) refuse_shape(name, array);
  return rows_of(array);
}

py::array_t<double> doubles(py::handle object, const char* name) {
  const py::array given = from_any(object, name);
  const char kind = given.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') refuse_type(name, "an array of numbers", object);
  return py::array_t<double, py::array::c_style | py::array::forcecast>(given);
}

std::vector<std::int64_t> integers(py::handle object, const char* name, std::size_t count) {
  const py::array given = from_any(object, name);
  const char kind = given.dtype().kind();
  if (kind != 'i' && kind != 'u' && given.size() > 0)
    throw py::type_error(std::string(name) + ": integers are wanted, not " +
                         py::str(py::handle(given.dtype())).cast<std::string>());
  if (static_cast<std::size_t>(given.size()) != count)
    refuse_value(name, std::to_string(given.size()) + " values for " + std::to_string(count) + " points");
  const auto wide = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>(given);
  std::vector<std::int64_t> numbers(wide.data(), wide.data() + wide.size());
  if (kind == 'u' && std::any_of(numbers.begin(), numbers.end(), [](std::int64_t n) { return n < 0; }))
    refuse_value(name, "a number is above 9223372036854775807");
  return numbers;
}

std::vector<std::uint32_t> point_labels(py::handle labels, std::size_t count) {
  const py::object of = py::hasattr(labels, "labels") ? py::object(labels.attr("labels"))
                                                      : py::reinterpret_borrow<py::object>(labels);
  std::vector<std::uint32_t> numbers;
  for (const std::int64_t label : integers(of, "labels", count)) {
    if (label < -2 || label > 4294967295)
      refuse_value("labels", std::to_string(label) + " is not at least -2 and at most 4294967295");
    numbers.push_back(static_cast<std::uint32_t>(label));
  }
  return numbers;
}

py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::array array_of(const Eigen::Vector3d& v) {
  return read_only(py::array_t<double>(3, v.data()));
}

py::array array_of(const Eigen::MatrixXd& m) {
  py::array_t<double> array({m.rows(), m.cols()});
  for (py::ssize_t i = 0; i < m.rows(); ++i) {
    for (py::ssize_t k = 0; k < m.cols(); ++k)
      array.mutable_at(i, k) = m(i, k);
  }
  return read_only(std::move(array));
}

py::array array_of(const std::vector<Eigen::Vector3d>& list) {
  py::array_t<double> array({static_cast<py::ssize_t>(list.size()), py::ssize_t{3}});
  if (!list.empty()) std::copy_n(list.front().data(), 3 * list.size(), array.mutable_data());
  return read_only(std::move(array));
}

}  // namespace pcl_bv::python
