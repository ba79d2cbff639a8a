// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Arrays of numpy as views of points, without a copy where there is a view, and results as arrays.
#pragma once

#include "pcl_bv/points/point_view.h"
#include "precompiled.h"

namespace pcl_bv::python {

namespace py = pybind11;

/// Points and the array that holds them. Made and destroyed with the GIL held; read without it.
struct PointArray {
  py::array owner;
  PointView view;
};

/// Points of an array (N, 3 or more) of float32 or float64 whose x, y, z are side by side, in rows any
/// positive distance apart; (H, W, 3 or more), as its rows; or of records with the fields x, y and z,
/// whatever their shape. Copied are Fortran's order, backward and overlapping rows, x, y, z that are not side
/// by side, masked arrays, whose masked numbers become NaN, and bytes of the other order. Other objects
/// become arrays first, as numpy.asarray() makes them; of tables with named columns x, y and z only those;
/// lists of whole numbers up to 2^53 become float64. An empty list has no point. Fields of records may be
/// integers of up to 32 bits.
///
/// TypeError for other numbers, ValueError for other shapes, and where rows are shorter than columns and have
/// 256 numbers or more: (4, N) is no N points. A UserWarning for 3 to 8 rows of more than 16.
PointArray points_of(py::handle object, const char* name = "points");

/// Whether it is an array with a mask (numpy.ma).
bool is_masked(py::handle object);

/// Numbers of any shape, as doubles in C's order.
py::array_t<double> doubles(py::handle object, const char* name);

/// Integers, one for each of `count` points.
std::vector<std::int64_t> integers(py::handle object, const char* name, std::size_t count);

/// Labels of `count` points, of an array or of what has `labels`: -1 and -2, none and ground, are 4294967295
/// and 4294967294.
std::vector<std::uint32_t> point_labels(py::handle labels, std::size_t count);

/// Read-only, as all that volumes give: what is written into a copy would be lost without a word.
py::array read_only(py::array array);
py::array array_of(const Eigen::Vector3d& v);
py::array array_of(const Eigen::MatrixXd& m);
py::array array_of(const std::vector<Eigen::Vector3d>& list);

/// An array that owns what was in the vector, which is not copied.
template <typename T>
py::array_t<T> take(std::vector<T>&& values) {
  auto* const held = new std::vector<T>(std::move(values));
  const py::capsule owner(held, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>({held->size()}, {sizeof(T)}, held->data(), owner);
}

/// A read-only view of a vector that lives as long as `owner`.
template <typename T>
py::array view_of_vector(const std::vector<T>& values, py::handle owner) {
  return read_only(py::array_t<T>({values.size()}, {sizeof(T)}, values.data(), owner));
}
template <typename T>
py::array view_of_part(const T* values, std::size_t count, py::handle owner) {
  return read_only(py::array_t<T>({count}, {sizeof(T)}, values, owner));
}

}  // namespace pcl_bv::python
