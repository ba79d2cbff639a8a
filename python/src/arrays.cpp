// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "arrays.h"

#include "arguments.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

bool is_real(const py::dtype& type) {
  return type.kind() == 'f' && (type.itemsize() == 4 || type.itemsize() == 8);
}

/// Returns whether the type has this machine's byte order. numpy marks this order by '=', types of one byte
/// by '|', and the other order by '<' or '>'.
bool is_native(const py::dtype& type) {
  return type.byteorder() == '=' || type.byteorder() == '|';
}

/// Returns advice for the error message about an array with numbers of this type, or "" if there is none.
std::string advice_for(const py::dtype& type) {
  if (type.kind() == 'c') return ": use array.real";
  if (type.kind() == 'f' || type.kind() == 'i' || type.kind() == 'u' || type.kind() == 'O')
    return ": use array.astype(numpy.float64)";
  return "";
}

[[noreturn]] void refuse_numbers(const char* name, const py::dtype& type, bool from_array) {
  throw py::type_error(std::string(name) + ": expected float32 or float64, got " +
                       py::str(py::handle(type)).cast<std::string>() + (from_array ? advice_for(type) : ""));
}

std::string shape_of(const py::array& array) {
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    shape += (i == 0 ? "" : ", ") + std::to_string(array.shape(i));
  return "(" + shape + (array.ndim() == 1 ? ",)" : ")");
}

[[noreturn]] void refuse_shape(const char* name, const py::array& array) {
  const bool one_point = array.ndim() == 1 && array.shape(0) >= 3 && array.shape(0) <= 8;
  throw py::value_error(std::string(name) + ": the shape " + shape_of(array) +
                        " is not (N, 3 or more) or (H, W, 3 or more)" +
                        (one_point ? ": for one point pass [point]" : ""));
}

/// Detects arrays with one point per column, such as the (4, N) of nuScenes. A point usually has 3 to 12
/// numbers. If there are fewer rows than columns, refuses 256 or more columns, and warns about 17 to 255
/// columns in 3 to 8 rows.
void check_layout(const char* name, const py::array& array) {
  const py::ssize_t columns = array.shape(array.ndim() - 1),
                    rows = array.size() / std::max<py::ssize_t>(columns, 1);
  const py::ssize_t first = array.shape(0);
  if (columns <= 16 || columns <= first) return;
  const std::string problem = "the shape " + shape_of(array) + " is " + std::to_string(rows) + " points of " +
                              std::to_string(columns) + " numbers. If each column is a point, pass points" +
                              (array.ndim() == 2 ? ".T" : " with x, y, z in the last axis") +
                              ". If each row is a point, pass points[..., :3]";
  if (columns >= 256) raise_value_error(name, problem);
  if (first >= 3 && first <= 8) warn(std::string(name) + ": " + problem);
}

/// Calls numpy.asarray(). If the call fails, raises a TypeError with the argument's name.
py::array as_numpy_array(py::handle object, const char* name) {
  py::array array = py::reinterpret_steal<py::array>(
      py::detail::npy_api::get().PyArray_FromAny_(object.ptr(), nullptr, 0, 0, 0, nullptr));
  if (array) return array;
  py::error_already_set error;
  if (!error.matches(PyExc_Exception)) throw error;  // a KeyboardInterrupt
  // The reason is numpy's text, for example about a tensor in GPU memory or rows of unequal length.
  const std::string reason = py::str(error.value()).cast<std::string>();
  throw py::type_error(std::string(name) + ": expected an array, got " + repr_text(object) +
                       (reason.empty() ? "" : ": " + reason));
}

/// Replaces masked numbers by NaN, so that their points are dropped and counted.
py::array without_mask(const py::array& array, const char* name) {
  if (!is_masked(array)) return array;
  if (!is_real(array.dtype())) refuse_numbers(name, array.dtype(), true);
  return array.attr("filled")(std::nan(""));
}

/// Converts whole numbers of a list to float64. Refuses numbers above 2^53 in magnitude. Arrays of integers
/// are not converted, but refused by points_of(), because the user has chosen their type.
py::array from_list(const py::array& array, py::handle object, const char* name) {
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u') return array;
  const py::int_ limit(std::int64_t{1} << 53);  // Python integers, because numpy would compare in float64
  const auto value_of = [&](const char* which) { return py::int_(array.attr(which)()); };
  const bool exact = array.size() == 0 || (value_of("max") <= limit && value_of("min") >= -limit);
  if (!exact)
    raise_value_error(name,
                      "integers above 2^53 cannot be converted to float64 exactly: " + repr_text(object));
  return array.attr("astype")("f8");
}

/// Returns the columns x, y and z of a table with named columns, such as a pandas.DataFrame. Returns any
/// other object unchanged.
py::object columns_xyz(py::handle object, const char* name) {
  if (py::isinstance<py::array>(object) || PyList_Check(object.ptr()) || PyTuple_Check(object.ptr()) ||
      !py::hasattr(object, "columns"))
    return py::reinterpret_borrow<py::object>(object);
  py::list wanted, columns(object.attr("columns"));
  for (const char* axis : {"x", "y", "z"})
    wanted.append(axis);
  const bool named =
      std::any_of(columns.begin(), columns.end(), [](auto c) { return PyUnicode_Check(c.ptr()); });
  if (!named) return py::reinterpret_borrow<py::object>(object);
  for (const auto& axis : wanted) {
    if (!columns.contains(axis))
      throw py::type_error(std::string(name) +
                           ": the table must have the columns x, y and z, its columns are " +
                           repr_text(columns));
  }
  return object[wanted];
}

/// Returns the points of a packed array (N, 3) of floats or doubles.
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

/// Returns the points of an array (N, 3 or more), as a view if possible, otherwise as a copy.
PointArray rows_of(const py::array& array) {
  const py::dtype type = array.dtype();
  const auto size = static_cast<std::size_t>(type.itemsize());
  const auto count = static_cast<std::size_t>(array.shape(0));
  const auto row = static_cast<std::size_t>(array.shape(1)) * size;  // bytes that belong to each point
  const py::ssize_t stride = count > 1 ? array.strides(0) : static_cast<py::ssize_t>(row);
  const bool adjacent = array.strides(1) == static_cast<py::ssize_t>(size);
  if (!is_native(type) || !adjacent || stride < static_cast<py::ssize_t>(3 * size)) return copied(array);
  PointArray points{array, {}};
  if (count == 0) return points;
  points.view.data = static_cast<const std::byte*>(array.data());
  points.view.stride = static_cast<std::size_t>(stride);
  points.view.readable = std::min(row, points.view.stride);
  points.view.count = count;
  points.view.scalar = size == 4 ? ScalarType::float32 : ScalarType::float64;
  return points;
}

/// A field of a record, with its offset in bytes.
struct Field {
  std::string name;
  py::dtype type;
  py::ssize_t offset;
};

/// Finds a field by its lower-case name, or else by its upper-case name, as the readers of files do.
Field field_of(const py::dtype& record, const char* field, const char* name) {
  const py::object fields = record.attr("fields");
  const std::string upper(1, static_cast<char>(field[0] - 'a' + 'A'));
  const std::string in_record = fields.contains(field) ? field : upper;
  if (!fields.contains(in_record))
    throw py::type_error(std::string(name) + ": the records lack the field '" + field +
                         "': " + repr_text(record));
  const py::tuple found = fields[py::str(in_record)];
  return {in_record, py::dtype::from_args(found[0]), found[1].cast<py::ssize_t>()};
}

/// Returns whether float32 represents all numbers of the type exactly.
bool fits_float32(const py::dtype& type) {
  return type.kind() == 'f' ? type.itemsize() == 4 : type.itemsize() <= 2;
}

/// Returns the points of a one-dimensional array of records, as a view if possible, otherwise as a copy.
PointArray records_of(const py::array& array, const char* name) {
  const py::dtype record = array.dtype();
  const Field x = field_of(record, "x", name), y = field_of(record, "y", name),
              z = field_of(record, "z", name);
  for (const Field* field : {&x, &y, &z}) {
    const bool whole =
        (field->type.kind() == 'i' || field->type.kind() == 'u') && field->type.itemsize() <= 4;
    if (!is_real(field->type) && !whole) refuse_numbers(name, field->type, true);
  }
  const py::ssize_t size = x.type.itemsize();
  const auto count = static_cast<std::size_t>(array.shape(0));
  const py::ssize_t stride = count > 1 ? array.strides(0) : record.itemsize();
  const bool real = is_real(x.type) && is_real(y.type) && is_real(z.type);
  const bool adjacent = real && y.type.itemsize() == size && z.type.itemsize() == size &&
                        y.offset == x.offset + size && z.offset == y.offset + size;
  const bool native = is_native(x.type) && is_native(y.type) && is_native(z.type);
  if (is_masked(array) || !adjacent || !native || stride < 3 * size) {
    const bool wide = !fits_float32(x.type) || !fits_float32(y.type) || !fits_float32(z.type);
    py::array xyz(wide ? py::dtype::of<double>() : py::dtype::of<float>(),
                  std::vector<py::ssize_t>{array.shape(0), 3});
    for (py::ssize_t k = 0; k < 3; ++k) {
      const Field* const fields[] = {&x, &y, &z};
      const py::object column =
          array[py::str(fields[k]->name)].attr("astype")(xyz.dtype());  // a masked column stays masked
      xyz[py::make_tuple(py::ellipsis(), k)] = without_mask(column, name);
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

bool is_masked(py::handle object) {
  if (Py_TYPE(object.ptr()) == py::detail::npy_api::get().PyArray_Type_) return false;  // the usual case
  return py::isinstance<py::array>(object) &&
         py::module_::import("numpy.ma").attr("isMaskedArray")(object).cast<bool>();
}

PointArray points_of(py::handle object, const char* name) {
  const bool is_array = py::isinstance<py::array>(object);
  const bool is_list = PyList_Check(object.ptr()) != 0 || PyTuple_Check(object.ptr()) != 0;
  py::array array =
      is_array ? py::reinterpret_borrow<py::array>(object) : as_numpy_array(columns_xyz(object, name), name);
  if (is_list) array = from_list(array, object, name);
  const py::dtype type = array.dtype();
  if (type.has_fields())
    return records_of(array.ndim() == 1 ? array : py::array(array.attr("reshape")(-1)), name);
  if (!is_real(type)) refuse_numbers(name, type, !is_list);
  if (array.ndim() == 1 && array.size() == 0)
    return packed(py::array_t<double>(std::vector<py::ssize_t>{0, 3}));
  if (array.ndim() < 2 || array.ndim() > 3 || array.shape(array.ndim() - 1) < 3) refuse_shape(name, array);
  check_layout(name, array);
  array = without_mask(array, name);
  if (array.ndim() == 3)
    array = array.attr("reshape")(py::make_tuple(array.shape(0) * array.shape(1), array.shape(2)));
  return rows_of(array);
}

py::array_t<double> doubles(py::handle object, const char* name) {
  if (is_masked(object))
    raise_type_error(name, "an array without a mask (use array.filled(numpy.nan))", object);
  const py::array given = as_numpy_array(object, name);
  const char kind = given.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') raise_type_error(name, "an array of numbers", object);
  return py::array_t<double, py::array::c_style | py::array::forcecast>(given);
}

py::array_t<double> point_times(py::handle object, const char* name, const PointView& points) {
  py::array_t<double> times = doubles(object, name);
  if (static_cast<std::size_t>(times.size()) != points.count)
    raise_value_error(
        name, std::to_string(times.size()) + " times for " + std::to_string(points.count) + " points");
  const double* const numbers = times.data();
  std::size_t invalid = 0, first = 0;
  for (std::size_t i = points.count; i-- > 0;) {
    if (std::isfinite(numbers[i]) || !is_valid(load_point(points, i))) continue;
    ++invalid;
    first = i;
  }
  if (invalid > 0)
    raise_value_error(name, std::to_string(numbers[first]) + " of point " + std::to_string(first) +
                                " is not finite (" + std::to_string(invalid) +
                                " such times of valid points)");
  return times;
}

std::vector<std::int64_t> integers(py::handle object, const char* name, std::size_t count) {
  if (is_masked(object)) raise_type_error(name, "integers without a mask (use array.filled(-1))", object);
  const py::array given = as_numpy_array(object, name);
  const char kind = given.dtype().kind();
  if (kind != 'i' && kind != 'u' && given.size() > 0)
    throw py::type_error(std::string(name) + ": expected integers, got " +
                         py::str(py::handle(given.dtype())).cast<std::string>());
  const py::int_ limit(std::numeric_limits<std::int64_t>::max());
  if (kind == 'u' && given.itemsize() == 8 && given.size() > 0 && py::int_(given.attr("max")()) > limit)
    raise_value_error(name, py::str(given.attr("max")()).cast<std::string>() + " is more than 2^63 - 1");
  if (static_cast<std::size_t>(given.size()) != count)
    raise_value_error(name,
                      std::to_string(given.size()) + " values for " + std::to_string(count) + " points");
  const auto wide = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>(given);
  return {wide.data(), wide.data() + wide.size()};
}

std::vector<std::uint32_t> point_labels(py::handle labels, std::size_t count) {
  const py::object of = py::hasattr(labels, "labels") ? py::object(labels.attr("labels"))
                                                      : py::reinterpret_borrow<py::object>(labels);
  std::vector<std::uint32_t> numbers;
  for (const std::int64_t label : integers(of, "labels", count)) {
    if (label < -2 || label > 4294967295)
      raise_value_error("labels", std::to_string(label) + " is not at least -2 and at most 4294967295");
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
