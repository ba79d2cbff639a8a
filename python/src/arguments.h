// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts arguments of Python calls to C++ values. An invalid argument raises a TypeError or a ValueError.
// The message gives the argument, the value and the allowed values. The messages of pybind11's own
// conversions do not give these facts.
#pragma once

#include "pcl_bv/parallel/execution.h"
#include "pipeline/config/settings.h"
#include "precompiled.h"

namespace pcl_bv::python {
using namespace detail;

namespace py = pybind11;

/// Raises a ValueError such as "threads: -1 is not at least 0".
[[noreturn]] void raise_value_error(const char* name, const std::string& what);

/// Issues a UserWarning. Throws an exception if Python's warning filters turn warnings into errors.
void warn(const std::string& text);

/// Raises a TypeError such as "tolerance: expected a number, got 'near'".
[[noreturn]] void raise_type_error(const char* name, const std::string& expected, py::handle value);

double number(py::handle value, const char* name, const NumberRange& range);
std::size_t whole_number(py::handle value, const char* name, const NumberRange& range);
/// Returns a signed integer of 64 bits.
std::int64_t signed_number(py::handle value, const char* name);
std::string text(py::handle value, const char* name);
std::filesystem::path path(py::handle value, const char* name);

/// Returns three finite numbers.
Eigen::Vector3d vector3(py::handle value, const char* name);

/// Parses the name of an enumerator or of a direction, as in configuration files (read_text() of
/// pipeline/config/settings.h).
template <typename T>
T parse_text(py::handle value, const char* name) {
  T read;
  try {
    read_text(text(value, name), read);
  } catch (const std::invalid_argument& error) {
    raise_value_error(name, error.what());
  }
  return read;
}

/// Returns PrismOptions::concave_length: infinity for None, otherwise a finite number above 0.
double concave_length_argument(py::handle value);

/// Returns the up direction. `value` must be "x", "-z", ... or three numbers.
Eigen::Vector3d up_argument(py::handle value);

/// Returns the method with this name or alias.
const Method* method_of(py::handle name);

/// Returns the methods of a name or of a list of names. The name "all" stands for methods_of_all(). Sets
/// `single` to true if `names` is the name of a single method, otherwise to false.
std::vector<const Method*> methods_of(py::handle names, bool& single);

/// Returns the policy for a number of threads. 1 means the calling thread, 0 means all processors.
ParallelPolicy policy_of(py::handle threads);
Execution execution_of(py::handle threads, py::handle isa);

/// Returns the rigid motion of a 4 x 4 matrix. The last row of the matrix must be 0 0 0 1, and the rotation
/// must be orthonormal to 1e-6.
Eigen::Isometry3d isometry(py::handle matrix, const char* name);

/// Returns a text that describes an object in error messages: at most 60 characters of its repr(), or its
/// type if repr() fails.
std::string repr_text(py::handle value);

}  // namespace pcl_bv::python
