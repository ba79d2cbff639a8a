// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts the pipeline's configuration from and to Python dicts, which are nested like the configuration
// file.
#pragma once

#include "pcl_bv/nodes/stream_runner.h"
#include "precompiled.h"

namespace pcl_bv::python {
using namespace detail;

/// Returns the configuration.
///
/// - `config` is None, a dict, the text of a configuration file, or the path of a configuration file.
/// - `preset` is None or a name. Settings in `config` override the preset.
/// - `settings` is a dict that overrides `config` and `preset`.
/// - `defaults` are the settings that none of them has.
///
/// For unknown keys and invalid values, raises a ValueError with the message of the configuration file's
/// parser.
PipelineConfig config_of(pybind11::handle config, pybind11::handle preset, const pybind11::dict& settings,
                         const PipelineConfig& defaults = {});

/// Returns all settings as a dict that config_of() accepts.
pybind11::dict dict_of(const PipelineConfig& config);

/// Returns a text with the default, unit, range and description of each setting, for Pipeline's docstring.
std::string settings_text();

}  // namespace pcl_bv::python
