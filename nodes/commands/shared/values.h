// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Texts of the command line to values; every refusal names the option, the text and what it should be.
#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace pcl_bv {

/// Wrong use: what() is the line for standard error, and the exit status is 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws UsageError, "--rate: 'fast' is not a rate": `what` is what follows the text.
[[noreturn]] void refuse_value(std::string_view option, std::string_view text, const std::string& what);

/// What `parse` makes of the text; its std::invalid_argument becomes a UsageError that names the option.
template <typename Text, typename Parse>
auto parse_with(std::string_view option, const Text& text, Parse parse) {
  try {
    return parse(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string(option) + ": " + error.what());
  }
}

/// All of these throw UsageError.
std::size_t parse_whole_number(std::string_view option, std::string_view text, std::size_t min = 0,
                               std::size_t max = std::numeric_limits<std::size_t>::max());
std::pair<double, double> parse_range(std::string_view text);

/// Floats of a point of .bin files: 3 to 32.
std::size_t parse_bin_fields(std::string_view text);

}  // namespace pcl_bv
