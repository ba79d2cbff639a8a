// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The functions that define the parts of the module. Docstrings begin with a signature and a line "--".
// inspect.signature() and help() show this signature.
#pragma once

#include "precompiled.h"

namespace pcl_bv::python {
using namespace detail;

/// Returns the docstring of a constructor, which inspect.signature() reads. This docstring is the signature
/// at the beginning of the class's docstring.
std::string init_doc(std::string_view class_doc);

void bind_volumes(pybind11::module_& module);
void bind_shapes(pybind11::module_& module);
void bind_fit(pybind11::module_& module);
void bind_partial(pybind11::module_& module);
void bind_object_shares(pybind11::module_& module);
void bind_segmentation(pybind11::module_& module);
void bind_pipeline(pybind11::module_& module);
void bind_result(pybind11::module_& module);
void bind_picture(pybind11::module_& module);
void bind_read(pybind11::module_& module);
void bind_gpu(pybind11::module_& module);  // in builds with the component gpu

}  // namespace pcl_bv::python
