// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts to values that only this command has.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options.h"

namespace pcl_bv {

/// All of these throw UsageError.
float parse_tolerance(std::string_view text);
std::optional<GroundOptions> parse_ground(std::string_view kind);
OutputFormat parse_format(std::string_view text);
ViewFrom parse_view(std::string_view text);
UsableIsa parse_usable_isa(const std::string& text);

/// What is fitted without --volume: a box, a sphere and an oriented box.
std::vector<const Method*> default_methods();

}  // namespace pcl_bv
