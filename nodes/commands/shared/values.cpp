// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "values.h"

#include "pipeline/config/names.h"

namespace pcl_bv::detail {

void reject_value(std::string_view option, std::string_view text, const std::string& what) {
  throw UsageError(std::string(option) + ": '" + std::string(text) + "' " + what);
}

std::size_t parse_whole_number(std::string_view option, std::string_view text, std::size_t min,
                               std::size_t max) {
  std::size_t value = 0;
  if (read_whole_text(text, value) && value >= min && value <= max) return value;
  std::string range = "is not a whole number of at least " + std::to_string(min);
  if (max != std::numeric_limits<std::size_t>::max()) range += " and at most " + std::to_string(max);
  reject_value(option, text, range);
}

void reject_useless(std::initializer_list<OptionUse> uses) {
  for (const OptionUse& use : uses)
    if (use.given && !use.useful)
      throw UsageError(std::string(use.option) + ": only useful with " + use.needed);
}

std::size_t parse_bin_fields(std::string_view text) {
  return parse_whole_number("--bin-fields", text, 3, 32);
}

}  // namespace pcl_bv::detail
