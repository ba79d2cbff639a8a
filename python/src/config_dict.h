// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The pipeline's configuration as Python writes it: dicts nested as the configuration file is.
#pragma once

#include "pcl_bv/nodes/stream_config.h"
#include "precompiled.h"

namespace pcl_bv::python {

/// `config`: None, a dict, the text of a configuration file, or a path to one. `preset`: None or a name.
/// `settings`: a dict that goes over both. ValueError, as the file's errors, for unknown keys and values that
/// are not allowed.
PipelineConfig config_of(pybind11::handle config, pybind11::handle preset, const pybind11::dict& settings);

/// The way back.
pybind11::dict dict_of(const PipelineConfig& config);

/// Every setting with its unit, default and range, a line each.
std::string settings_text();

}  // namespace pcl_bv::python
