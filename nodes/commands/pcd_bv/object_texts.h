// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The texts in files of objects: options, and objects with their volumes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "object_fitter.h"

namespace pcl_bv::detail {

/// Returns a text of all that the ground of --ground slope depends on.
std::string ground_text(const GroundConfig& config);

/// Returns a text of all that components depend on.
std::string clusters_text(const PipelineConfig& config);

/// Returns a text of all that the volumes of a class depend on.
std::string volumes_text(const PipelineConfig& config, const ClassTable& table,
                         std::optional<std::int64_t> value);

std::string text_of(const Object& object);
Object object_of(const std::string& text);

}  // namespace pcl_bv::detail
