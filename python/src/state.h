// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What pickle gives back comes from outside: it is checked like arguments.
#pragma once

#include "arguments.h"

namespace pcl_bv::python {

/// What `make` makes of a state. Whatever it finds wrong is a ValueError: "Sphere: a state that is none of
/// its own".
template <typename Make>
auto of_state(const std::string& name, const Make& make) {
  const std::string what = name + ": a state that is none of its own";
  try {
    return make();
  } catch (const py::error_already_set& error) {
    if (error.matches(PyExc_MemoryError) || error.matches(PyExc_KeyboardInterrupt)) throw;
    throw py::value_error(what);
  } catch (const py::cast_error&) {
    throw py::value_error(what);
  } catch (const std::runtime_error& error) {  // ours, of settings and of arguments
    throw py::value_error(what + ": " + error.what());
  } catch (const std::length_error&) {
    throw py::value_error(what);
  } catch (const std::logic_error& error) {
    throw py::value_error(what + ": " + error.what());
  }
}

/// The parts of a tuple. Throws py::value_error where it is none, or has another number of them.
inline py::tuple parts_of_state(py::handle state, std::size_t count) {
  if (!py::isinstance<py::tuple>(state)) throw py::value_error("it is no tuple");
  auto parts = py::reinterpret_borrow<py::tuple>(state);
  if (parts.size() != count) throw py::value_error("it has not " + std::to_string(count) + " parts");
  return parts;
}

/// A number of points; an array of one number is none.
inline std::size_t points_of_state(py::handle part) {
  if (PyLong_Check(part.ptr()) == 0) throw py::value_error("its number of points is no whole number");
  return whole_number(part, "points", {0, std::numeric_limits<std::int32_t>::max()});
}

}  // namespace pcl_bv::python
