// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts the pipeline's configuration from and to Python dicts, which are nested like the configuration
// file.
#pragma once

#include "pcl_bv/nodes/stream_config.h"
#include "precompiled.h"

namespace pcl_bv::python {

/// Returns the configuration. `config`: None, a dict, the text of a configuration file, or a path to one.
/// `preset`: None or a name; `config` overrides it. `settings`: a dict that overrides both. Raises a
/// ValueError, with the messages of the configuration file's parser, for unknown keys and invalid values.
PipelineConfig config_of(pybind11::handle config, pybind11::handle preset, const pybind11::dict& settings);

/// Returns all settings as a dict that config_of() accepts.
pybind11::dict dict_of(const PipelineConfig& config);

/// Returns a text with the default, unit, range and description of each setting, for the docstring.
std::string settings_text();

}  // namespace pcl_bv::python
