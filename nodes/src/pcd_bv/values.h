// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts of the command line to values; every refusal names the option, the text and what it should be.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "options.h"

namespace pcl_bv {

/// All of these throw UsageError.
std::size_t parse_whole_number(std::string_view option, std::string_view text, std::size_t min,
                               std::size_t max);
float parse_tolerance(std::string_view text);
RangeFilter parse_range(std::string_view text);
std::optional<GroundOptions> parse_ground(std::string_view kind);
UpAxis parse_up(std::string_view text);
double parse_sensor_height(std::string_view text);
OutputFormat parse_format(std::string_view text);
ViewFrom parse_view(std::string_view text);
Isa parse_usable_isa(const std::string& text);
SphereGrowth parse_sphere_growth(std::string_view text);

/// Methods of a comma-separated list of names, aliases and `all`, each once, in the order of its first
/// mention.
std::vector<const Method*> parse_methods(std::string_view list);

/// What is fitted without --volume: a box, a sphere and an oriented box, as far as this build has them.
std::vector<const Method*> default_methods();

/// The error for something that the documentation promises and this build has not.
UsageError not_available_yet(const std::string& what);

}  // namespace pcl_bv
