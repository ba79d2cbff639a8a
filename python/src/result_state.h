// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts results to and from the state that pickle stores.
#pragma once

#include "result_object.h"

namespace pcl_bv::python {
using namespace detail;

py::dict state_of_result(const std::shared_ptr<ResultObject>& result);
std::shared_ptr<ResultObject> result_of_state(py::handle state);

}  // namespace pcl_bv::python
