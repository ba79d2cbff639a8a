// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <stdexcept>

#include "bind.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/io/untrusted_text.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/nodes/stream_runner.h"
#include "pcl_bv/points/isa.h"

namespace pcl_bv::python {
using namespace detail;

namespace py = pybind11;

namespace {

void translate(std::exception_ptr error) {  // NOLINT(performance-unnecessary-value-param): pybind11's type
  try {
    if (error) std::rethrow_exception(error);
  } catch (const IoError& e) {
    PyErr_SetString(PyExc_OSError, message_line(e.what()).c_str());
  } catch (const FrameError& e) {
    PyErr_SetString(PyExc_OSError, message_line(e.what()).c_str());
  } catch (const MessageError& e) {
    PyErr_SetString(PyExc_OSError, message_line(e.what()).c_str());
  } catch (const ConfigError& e) {
    PyErr_SetString(PyExc_ValueError, message_line(e.what()).c_str());
  } catch (const std::invalid_argument& e) {
    PyErr_SetString(PyExc_ValueError, message_line(e.what()).c_str());
  }
}

// An object whose __init__() was not called, such as that of Aabb.__new__(Aabb) or of a pickle without a
// state, has no value. When it is used, pybind11 calls this function to allocate the value, and leaves it
// uninitialised.
void* reject_missing_value(std::size_t) {
  throw py::type_error("the object has no value, because its __init__() was not called");
}

void reject_missing_values(const py::module_& module) {
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (PyType_Check(value.ptr()) == 0) continue;
    auto* const type = reinterpret_cast<PyTypeObject*>(value.ptr());
    if (py::detail::type_info* const known = py::detail::get_type_info(type))
      known->operator_new = reject_missing_value;
  }
}

}  // namespace

std::string init_doc(std::string_view class_doc) {
  const std::size_t begin = class_doc.find('(') + 1;
  return "__init__(self, " + std::string(class_doc.substr(begin, class_doc.find('\n') - begin)) + "\n--\n\n";
}

}  // namespace pcl_bv::python

PYBIND11_MODULE(_pcl_bv, module) {
  using namespace pcl_bv::python;
  pybind11::options options;
  options.disable_function_signatures();
  pybind11::register_local_exception_translator(translate);
  module.attr("__version__") = PCL_BV_VERSION;
  for (const auto bind : {bind_volumes, bind_shapes, bind_fit, bind_partial, bind_object_shares,
                          bind_segmentation, bind_result, bind_pipeline, bind_picture, bind_read})
    bind(module);
  reject_missing_values(module);
#if defined(PCL_BV_GPU)
  bind_gpu(module);
  reject_missing_values(module.attr("_gpu"));
#endif
  pybind11::list sets;
  for (const pcl_bv::Isa isa : pcl_bv::usable_isas())
    sets.append(std::string(pcl_bv::isa_name(isa)));
  module.attr("instruction_sets") = pybind11::tuple(sets);
}
