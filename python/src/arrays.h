// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts numpy arrays to views of points, without a copy where possible, and results to numpy arrays.
#pragma once

#include "pcl_bv/points/point_view.h"
#include "precompiled.h"

namespace pcl_bv::python {
using namespace detail;

namespace py = pybind11;

/// A view of points, and the array that owns the points. Constructing and destroying a PointArray needs the
/// GIL. Reading the points does not.
struct PointArray {
  py::array owner;
  PointView view;
};

/// Returns the points of an argument:
///
/// - an array (N, 3 or more) or (H, W, 3 or more) of float32 or float64, whose last axis begins with x, y, z;
/// - an array of records of any shape with the fields x, y, z (or X, Y, Z) of float32, float64 or integers of
///   up to 32 bits;
/// - a table with named columns, of which x, y and z are used;
/// - any other object that numpy.asarray() converts to one of these arrays. Whole numbers of lists become
///   float64 and are allowed up to 2^53. An empty list has no points.
///
/// The points are not copied if x, y, z are adjacent and the rows do not overlap. There may be gaps between
/// rows. Copies are made of
///
/// - arrays in Fortran order and arrays with backward or overlapping rows;
/// - arrays in which x, y, z are not adjacent;
/// - records with integer fields, and arrays with the other byte order;
/// - masked arrays. Their masked numbers become NaN.
///
/// Raises a TypeError for other types of numbers, and a ValueError for other shapes. If there are fewer rows
/// than columns, each column is probably a point. In this case 256 or more columns raise a ValueError, and 17
/// to 255 columns in 3 to 8 rows give a UserWarning.
PointArray points_of(py::handle object, const char* name = "points");

/// Returns whether the object is an array with a mask (numpy.ma).
bool is_masked(py::handle object);

/// Returns an array of numbers of any shape as doubles in C order.
py::array_t<double> doubles(py::handle object, const char* name);

/// Returns the times of points, one for each point, as doubles. Raises a TypeError for anything else than
/// floats and integers, and a ValueError for another number of times, or if the time of a valid point is not
/// finite.
py::array_t<double> point_times(py::handle object, const char* name, const PointView& points);

/// Returns an array of integers, one for each of `count` points.
std::vector<std::int64_t> integers(py::handle object, const char* name, std::size_t count);

/// Returns the labels of `count` points, from an array or from an object with the attribute `labels`. The
/// labels -1 (none) and -2 (ground) become 4294967295 and 4294967294.
std::vector<std::uint32_t> point_labels(py::handle labels, std::size_t count);

/// Makes an array read-only. The arrays of volumes are copies, so writing to an array would not change its
/// volume.
py::array read_only(py::array array);
py::array array_of(const Eigen::Vector3d& v);
py::array array_of(const Eigen::MatrixXd& m);
py::array array_of(const std::vector<Eigen::Vector3d>& list);

/// Returns an array that takes over the vector's memory, without a copy.
template <typename T>
py::array_t<T> array_from_vector(std::vector<T>&& values) {
  auto* const held = new std::vector<T>(std::move(values));
  const py::capsule owner(held, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>({held->size()}, {sizeof(T)}, held->data(), owner);
}

/// Returns a read-only view of a vector that `owner` keeps alive.
template <typename T>
py::array view_of_vector(const std::vector<T>& values, py::handle owner) {
  return read_only(py::array_t<T>({values.size()}, {sizeof(T)}, values.data(), owner));
}
template <typename T>
py::array view_of_part(const T* values, std::size_t count, py::handle owner) {
  return read_only(py::array_t<T>({count}, {sizeof(T)}, values, owner));
}

}  // namespace pcl_bv::python
