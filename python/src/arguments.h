// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Arguments of Python's calls as C++ values. What cannot be one is a TypeError or a ValueError that names the
// argument, the value and what is allowed, which pybind11's own conversions do not say.
#pragma once

#include "pcl_bv/fitting/execution.h"
#include "pipeline/config/settings.h"
#include "precompiled.h"

namespace pcl_bv::python {

namespace py = pybind11;

/// "threads: -1 is not at least 0".
[[noreturn]] void refuse_value(const char* name, const std::string& what);

/// Issues a UserWarning, which becomes an exception where Python's filters say so.
void warn(const std::string& text);

/// "tolerance: a number is wanted, not 'near'".
[[noreturn]] void refuse_type(const char* name, const std::string& wanted, py::handle value);

double number(py::handle value, const char* name, const NumberRange& range);
std::size_t whole_number(py::handle value, const char* name, const NumberRange& range);
/// Of 64 bits, negative ones too.
std::int64_t signed_number(py::handle value, const char* name);
std::string text(py::handle value, const char* name);
std::filesystem::path path(py::handle value, const char* name);

/// Of three finite numbers.
Eigen::Vector3d vector3(py::handle value, const char* name);

/// One of a setting's names, or a direction as the settings take it: read_text() of nodes/settings.h.
template <typename T>
T word(py::handle value, const char* name) {
  T read;
  try {
    read_text(text(value, name), read);
  } catch (const std::invalid_argument& error) {
    refuse_value(name, error.what());
  }
  return read;
}

/// "x", "-z", ... or three numbers.
Eigen::Vector3d up_argument(py::handle value);

/// The method of this name or alias.
const Method* method_of(py::handle name);

/// A name, or a list of names; "all" in it stands for methods_of_all(). `one`: whether it was a single name
/// of one.
std::vector<const Method*> methods_of(py::handle names, bool& one);

/// 1: the calling thread; 0: all processors.
ParallelPolicy policy_of(py::handle threads);
Execution execution_of(py::handle threads, py::handle isa);

/// A rigid motion as a matrix of 4 x 4 whose last row is 0 0 0 1.
Eigen::Isometry3d isometry(py::handle matrix, const char* name);

/// An object in an error message: its repr(), of at most 60 characters; its type where it has none.
std::string shown(py::handle value);

}  // namespace pcl_bv::python
