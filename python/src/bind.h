// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The parts of the module. Docstrings begin with a signature and a line "--", which inspect.signature() and
// help() take for the function's own.
#pragma once

#include "precompiled.h"

namespace pcl_bv::python {

/// For a constructor, which inspect.signature() asks: the signature that begins the docstring of its class.
std::string init_doc(std::string_view class_doc);

void bind_volumes(pybind11::module_& module);
void bind_shapes(pybind11::module_& module);
void bind_fit(pybind11::module_& module);
void bind_partial(pybind11::module_& module);
void bind_segmentation(pybind11::module_& module);
void bind_pipeline(pybind11::module_& module);
void bind_result(pybind11::module_& module);
void bind_picture(pybind11::module_& module);
void bind_read(pybind11::module_& module);

}  // namespace pcl_bv::python
