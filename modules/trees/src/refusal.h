// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace pcl_bv {

/// Throws std::invalid_argument: what must be how, and what it is.
[[noreturn]] inline void refuse(const std::string& what_it_must_be, double value) {
  std::ostringstream what;
  what << what_it_must_be << ", not " << value;
  throw std::invalid_argument(what.str());
}

inline void require_distance(const char* whose, double distance) {
  if (!(distance >= 0)) refuse(std::string(whose) + ": a distance must be 0 or more", distance);
}

/// What Neighbor::squared_distance may be for points within a distance.
inline double square_limit(double distance) {
  require_distance("PointTree", distance);
  return distance * distance;
}

}  // namespace pcl_bv
