// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bind.h"
#include "pcl_bv/io/io_error.h"
#include "pcl_bv/kernels/isa.h"
#include "pcl_bv/messages/serialize.h"
#include "pcl_bv/nodes/frame_source.h"
#include "pcl_bv/nodes/stream_config.h"

namespace pcl_bv::python {
namespace {

void translate(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (const IoError& e) {
    PyErr_SetString(PyExc_OSError, e.what());
  } catch (const FrameError& e) {
    PyErr_SetString(PyExc_OSError, e.what());
  } catch (const MessageError& e) {
    PyErr_SetString(PyExc_OSError, e.what());
  } catch (const ConfigError& e) {
    PyErr_SetString(PyExc_ValueError, e.what());
  }
}

}  // namespace
}  // namespace pcl_bv::python

PYBIND11_MODULE(_pcl_bv, module) {
  pybind11::options options;
  options.disable_function_signatures();
  pybind11::register_local_exception_translator(pcl_bv::python::translate);
  module.attr("__version__") = PCL_BV_VERSION;
  pcl_bv::python::bind_volumes(module);
  pcl_bv::python::bind_shapes(module);
  pcl_bv::python::bind_fit(module);
  pybind11::list sets;
  for (const pcl_bv::Isa isa : pcl_bv::usable_isas())
    sets.append(std::string(pcl_bv::isa_name(isa)));
  module.attr("instruction_sets") = pybind11::tuple(sets);
}
