// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parses values of the command line. Every error names the option, the text and the allowed values.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pcl_bv::detail {

/// Wrong use of a command. what() is the line for standard error. The command exits with status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws a UsageError such as "--rate: 'fast' is not a rate", where `what` is "is not a rate".
[[noreturn]] void reject_value(std::string_view option, std::string_view text, const std::string& what);

/// Returns parse(text). A std::invalid_argument becomes a UsageError that names the option.
template <typename Text, typename Parse>
auto parse_with(std::string_view option, const Text& text, Parse parse) {
  try {
    return parse(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string(option) + ": " + error.what());
  }
}

/// Parses a whole number from `min` to `max`. Throws UsageError for any other text.
std::size_t parse_whole_number(std::string_view option, std::string_view text, std::size_t min = 0,
                               std::size_t max = std::numeric_limits<std::size_t>::max());

/// An option of the command line that has an effect only on some inputs or with some other option.
struct OptionUse {
  const char* option;
  bool given;
  bool useful;
  const char* needed;  ///< What it needs, such as "a recording".
};

/// Throws UsageError for the first option that is given but not useful.
void reject_useless(std::initializer_list<OptionUse> uses);

/// Parses the number of floats per point of .bin files, which is 3 to 32. Throws UsageError for any other
/// text.
std::size_t parse_bin_fields(std::string_view text);

}  // namespace pcl_bv::detail
