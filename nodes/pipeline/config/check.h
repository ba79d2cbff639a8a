// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checks of configured values.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "settings.h"

#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A setting whose value is not allowed.
struct ConfigProblem {
  std::string key;
  std::string what;  ///< The value and the allowed values. Names other settings by a SettingName.
};

/// Return the problems of single settings. If there are none, return those of combinations of settings. All
/// configurations are checked by these functions: those from files, options, other programs and C++.
std::vector<ConfigProblem> problems_of(const PipelineConfig& config,
                                       const SettingName& name = key_of_setting);
std::vector<ConfigProblem> problems_of(const RunnerConfig& config);
std::vector<ConfigProblem> problems_of(const RigConfig& rig, const SettingName& name = key_of_setting);
std::vector<ConfigProblem> problems_of(const StreamConfig& config, const SettingName& name = key_of_setting);

/// Throws std::invalid_argument with all problems, unless there are none.
void throw_if_any(const std::vector<ConfigProblem>& problems);

/// Returns the allowed range of a whole number as text, such as " of at least 1 and at most 1000".
std::string whole_number_range(const NumberRange& range);

/// Same as read_text(), but errors of whole numbers also state the allowed range. Thus the errors for "-1"
/// and "1e300" have the same words as the error for a 0 that is too small.
template <typename T>
void read_setting(const Setting& setting, std::string_view text, T& value) {
  constexpr bool count = std::is_same_v<T, std::size_t> || std::is_same_v<T, std::optional<std::size_t>>;
  try {
    read_text(text, value);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(error.what() + (count ? whole_number_range(setting.range) : std::string()));
  }
}

}  // namespace detail
}  // namespace pcl_bv
