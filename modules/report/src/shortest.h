// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

namespace pcl_bv {

/// The fewest digits that read back as exactly this double; never -0. Throws std::domain_error if it is not
/// finite.
inline std::string shortest(double value) {
  if (!std::isfinite(value)) throw std::domain_error("a volume has a number that is not finite");
  if (value == 0) return "0";
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace pcl_bv
