// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "settings.h"

#include "pcl_bv/nodes/stream_config.h"

namespace pcl_bv {

/// A value that is not allowed.
struct ConfigProblem {
  std::string key;
  std::string what;  ///< The value and what is allowed.
};

std::vector<ConfigProblem> problems_of(const StreamConfig& config);

/// " of at least 1 and at most 1000", for whole numbers.
std::string whole_number_range(const NumberRange& range);

/// read_text(), whose error says the range, too, where a whole number is wanted: "-1" and "1e300" are refused
/// in the words of 0.
template <typename T>
void read_setting(const Setting& setting, std::string_view text, T& value) {
  constexpr bool count = std::is_same_v<T, std::size_t> || std::is_same_v<T, std::optional<std::size_t>>;
  try {
    read_text(text, value);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(error.what() + (count ? whole_number_range(setting.range) : std::string()));
  }
}

}  // namespace pcl_bv
