// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Functions that write numbers, method names and upright boxes in the same way in all report formats.
#pragma once

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv::detail {

/// Appends the fewest digits that read back as exactly this double. -0 becomes 0. Throws std::domain_error if
/// the value is not finite.
inline void append_shortest(double value, std::string& text) {
  if (!std::isfinite(value)) throw std::domain_error("a volume has a number that is not finite");
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value == 0 ? 0.0 : value).ptr);
}

inline std::string shortest(double value) {
  std::string text;
  append_shortest(value, text);
  return text;
}

/// Returns the method's name. The method `best` is followed by the shape that it chose, such as "best (obb)".
inline std::string method_label(const VolumeEntry& entry) {
  if (entry.method != "best" || empty(entry.volume)) return entry.method;
  return entry.method + " (" + std::string(shape_name(entry.volume)) + ')';
}

/// Returns the box of an upright method (with length, width, height and yaw). Returns null for other methods
/// and for an empty box.
inline const Obb* upright_box(const VolumeEntry& entry) {
  const Obb* const box = std::get_if<Obb>(&entry.volume);
  if (box == nullptr || box->empty()) return nullptr;
  const Method* const method = find_method(entry.method);
  return method != nullptr && method->upright ? box : nullptr;
}

}  // namespace pcl_bv::detail
