// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Reads unpickled states. A state comes from outside the program, so it is checked like arguments.
#pragma once

#include "arguments.h"

namespace pcl_bv::python {
using namespace detail;

/// Returns make(), which must construct an object from a state. Turns any error except MemoryError and
/// KeyboardInterrupt into a ValueError such as "Sphere: invalid pickled state".
template <typename Make>
auto restore_from_state(const std::string& name, const Make& make) {
  const std::string what = name + ": invalid pickled state";
  try {
    return make();
  } catch (const py::error_already_set& error) {
    if (error.matches(PyExc_MemoryError) || error.matches(PyExc_KeyboardInterrupt)) throw;
    throw py::value_error(what);
  } catch (const py::cast_error&) {
    throw py::value_error(what);
  } catch (const std::runtime_error& error) {  // errors in settings or arguments
    throw py::value_error(what + ": " + error.what());
  } catch (const std::length_error&) {
    throw py::value_error(what);
  } catch (const std::logic_error& error) {
    throw py::value_error(what + ": " + error.what());
  }
}

/// Returns the elements of a tuple. Throws py::value_error if `state` is not a tuple of `count` elements.
inline py::tuple tuple_of_state(py::handle state, std::size_t count) {
  if (!py::isinstance<py::tuple>(state)) throw py::value_error("the state is not a tuple");
  auto parts = py::reinterpret_borrow<py::tuple>(state);
  if (parts.size() != count)
    throw py::value_error("the state does not have " + std::to_string(count) + " parts");
  return parts;
}

/// Reads the element of a state that is the number of points. It must be a Python int. An array with one
/// element is not accepted.
inline std::size_t points_of_state(py::handle part) {
  if (PyLong_Check(part.ptr()) == 0) throw py::value_error("the number of points is not an integer");
  return whole_number(part, "points", {0, std::numeric_limits<std::int32_t>::max()});
}

}  // namespace pcl_bv::python
