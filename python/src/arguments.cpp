// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "arguments.h"

#include "arrays.h"
#include "pcl_bv/io/untrusted_text.h"

namespace pcl_bv::python {
using namespace detail;
namespace {

// Clears Python's current error if it is an Exception. Otherwise throws the error: it is, for example, the
// KeyboardInterrupt of Ctrl-C, which may interrupt any Python code.
void clear_error() {
  if (PyErr_Occurred() != nullptr && PyErr_ExceptionMatches(PyExc_Exception) == 0)
    throw py::error_already_set();
  PyErr_Clear();
}

}  // namespace

void raise_value_error(const char* name, const std::string& what) {
  throw py::value_error(std::string(name) + ": " + what);
}

// Imports the module `warnings` first. Without this module, CPython prints the warning by C code, and this
// code clears a KeyboardInterrupt that is raised meanwhile. On a busy machine, 24 of 60 interrupts just
// before the first warning were lost.
void warn(const std::string& text) {
  py::module_::import("warnings");
  if (PyErr_WarnEx(PyExc_UserWarning, message_line(text).c_str(), 1) != 0) throw py::error_already_set();
}

void raise_type_error(const char* name, const std::string& expected, py::handle value) {
  throw py::type_error(std::string(name) + ": expected " + expected + ", got " + repr_text(value));
}

std::string repr_text(py::handle value) {
  constexpr std::size_t longest = 60;
  const py::object repr = py::reinterpret_steal<py::object>(PyObject_Repr(value.ptr()));
  Py_ssize_t size = 0;
  const char* const characters = repr ? PyUnicode_AsUTF8AndSize(repr.ptr(), &size) : nullptr;
  if (characters == nullptr) {  // repr() failed (nested too deep) or has a lone surrogate
    clear_error();
    return std::string("one of ") + Py_TYPE(value.ptr())->tp_name;
  }
  std::string text(characters, static_cast<std::size_t>(size));
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.size() > longest) text = text.substr(0, longest - 3) + "...";
  return text;
}

double number(py::handle value, const char* name, const NumberRange& range) {
  if (PyBool_Check(value.ptr())) raise_type_error(name, "a number", value);
  const double read = PyFloat_AsDouble(value.ptr());
  if (read == -1 && PyErr_Occurred() != nullptr) {
    clear_error();
    raise_type_error(name, "a number", value);
  }
  Setting setting{name, "", ""};
  setting.range = range;
  const std::string problem = problem_of(setting, read);
  if (!problem.empty()) raise_value_error(name, problem);
  return read;
}

namespace {

py::object whole_object(py::handle value, const char* name) {
  if (PyBool_Check(value.ptr()) || PyIndex_Check(value.ptr()) == 0)
    raise_type_error(name, "a whole number", value);
  py::object whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!whole) throw py::error_already_set();
  return whole;
}

}  // namespace

std::int64_t signed_number(py::handle value, const char* name) {
  const py::object whole = whole_object(value, name);
  int overflow = 0;
  const long long read = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
  if (overflow != 0)
    raise_value_error(
        name, repr_text(value) + " is not at least -9223372036854775808 and at most 9223372036854775807");
  return read;
}

std::size_t whole_number(py::handle value, const char* name, const NumberRange& range) {
  const py::object whole = whole_object(value, name);
  const std::size_t read = PyLong_AsSize_t(whole.ptr());
  if (read == static_cast<std::size_t>(-1) && PyErr_Occurred() != nullptr) {
    clear_error();
    raise_value_error(name, repr_text(value) + " is not a whole number of at least 0 that fits 64 bits");
  }
  Setting setting{name, "", ""};
  setting.range = range;
  const std::string problem = problem_of(setting, read);
  if (!problem.empty()) raise_value_error(name, problem);
  return read;
}

std::string text(py::handle value, const char* name) {
  if (!PyUnicode_Check(value.ptr())) raise_type_error(name, "a text", value);
  return value.cast<std::string>();
}

std::filesystem::path path(py::handle value, const char* name) {
  const py::object path = py::reinterpret_steal<py::object>(PyOS_FSPath(value.ptr()));
  if (!path) {
    clear_error();
    raise_type_error(name, "a path", value);
  }
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(path.ptr(), &bytes) == 0) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(bytes).cast<std::string>();
}

Eigen::Vector3d vector3(py::handle value, const char* name) {
  const auto numbers = doubles(value, name);
  if (numbers.size() != 3) raise_value_error(name, "expected three numbers, got " + repr_text(value));
  Eigen::Vector3d v(numbers.data()[0], numbers.data()[1], numbers.data()[2]);
  if (!v.allFinite()) raise_value_error(name, repr_text(value) + " is not finite");
  return v;
}

Eigen::Vector3d up_argument(py::handle value) {
  Eigen::Vector3d up =
      PyUnicode_Check(value.ptr()) ? parse_text<Eigen::Vector3d>(value, "up") : vector3(value, "up");
  const std::string problem = problem_of(Setting{"up", "", ""}, up);
  if (!problem.empty()) raise_value_error("up", problem);
  return up;
}

double concave_length_argument(py::handle value) {
  if (value.is_none()) return kNoLimit;
  return number(value, "concave_length", range_of("concave_length"));
}

const Method* method_of(py::handle name) {
  Py_ssize_t size = 0;
  const char* const characters =
      PyUnicode_Check(name.ptr()) ? PyUnicode_AsUTF8AndSize(name.ptr(), &size) : nullptr;
  if (characters == nullptr) {
    clear_error();
    raise_type_error("method", "a name or a list of names", name);
  }
  const Method* const method = find_method({characters, static_cast<std::size_t>(size)});
  if (method != nullptr) return method;
  std::string known;
  for (const Method& each : methods())
    known.append(known.empty() ? "" : ", ").append(each.name);
  raise_value_error("method", repr_text(name) + " is not one of " + known + ", or all");
}

std::vector<const Method*> methods_of(py::handle names, bool& single) {
  const auto is_all = [](py::handle name) {
    return PyUnicode_Check(name.ptr()) && PyUnicode_CompareWithASCIIString(name.ptr(), "all") == 0;
  };
  single = PyUnicode_Check(names.ptr()) && !is_all(names);
  if (single) return {method_of(names)};
  if (is_all(names)) return methods_of_all();
  if (!PyList_Check(names.ptr()) && !PyTuple_Check(names.ptr()))
    raise_type_error("method", "a name or a list of names", names);
  std::vector<const Method*> found;
  for (const py::handle name : names) {
    if (is_all(name)) {
      found.insert(found.end(), methods_of_all().begin(), methods_of_all().end());
    } else {
      found.push_back(method_of(name));
    }
  }
  if (found.empty()) raise_value_error("method", "the list of methods is empty");
  return found;
}

ParallelPolicy policy_of(py::handle threads) {
  const std::size_t n = whole_number(threads, "threads", {0, 1024});
  if (n == 1) return Serial{};
  return Threads{static_cast<unsigned>(n)};
}

Execution execution_of(py::handle threads, py::handle isa) {
  Execution execution;
  execution.parallel = policy_of(threads);
  if (isa.is_none()) return execution;
  try {
    execution.isa = parse_isa(text(isa, "isa"));
  } catch (const std::invalid_argument& error) {
    raise_value_error("isa", error.what());
  }
  return execution;
}

Eigen::Isometry3d isometry(py::handle matrix, const char* name) {
  const auto numbers = doubles(matrix, name);
  if (numbers.ndim() != 2 || numbers.shape(0) != 4 || numbers.shape(1) != 4)
    raise_value_error(name, "expected a matrix of 4 x 4 numbers, got " + repr_text(matrix));
  const Eigen::Matrix4d m = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  const Eigen::Matrix3d rotation = m.topLeftCorner<3, 3>();
  // This tolerance accepts rotations that are rounded to float. Transformed volumes are inflated by the
  // deviation from an orthonormal matrix.
  constexpr double max_deviation = 1e-6;
  if (!m.allFinite() || m.row(3) != Eigen::RowVector4d(0, 0, 0, 1) || rotation.determinant() < 0 ||
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > max_deviation)
    raise_value_error(
        name, "expected a 4 x 4 rigid transform (rotation orthonormal to 1e-6, last row 0 0 0 1), got " +
                  repr_text(matrix));
  Eigen::Isometry3d motion;
  motion.matrix() = m;
  return motion;
}

}  // namespace pcl_bv::python
