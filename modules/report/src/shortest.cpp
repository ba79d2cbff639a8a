// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "shortest.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace pcl_bv {

std::string shortest(double value) {
  if (!std::isfinite(value)) throw std::domain_error("a volume has a number that is not finite");
  if (value == 0) return "0";
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace pcl_bv
