// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checks of function arguments.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace pcl_bv::detail {

/// Throws std::invalid_argument with the text "<what_it_must_be>, not <value>".
[[noreturn]] inline void throw_out_of_range_value(const std::string& what_it_must_be, double value) {
  std::ostringstream what;
  what << what_it_must_be << ", not " << value;
  throw std::invalid_argument(what.str());
}

/// Throws std::invalid_argument if the distance is negative or NaN.
inline void require_distance(const char* class_name, double distance) {
  if (!(distance >= 0))
    throw_out_of_range_value(std::string(class_name) + ": a distance must be 0 or more", distance);
}

/// Returns the largest Neighbor::squared_distance of points within a distance.
inline double square_limit(double distance) {
  require_distance("PointTree", distance);
  return distance * distance;
}

}  // namespace pcl_bv::detail
