// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>

namespace pcl_bv::detail {

/// Returns the side of a cell for the density of points (PlanBasins) at this distance from the sensor,
/// metres: 7 cm, and 2 mm more for each metre beyond 35 m. Spinning LiDARs have azimuth steps of 0.1 to 0.4
/// degrees, 1.7 to 7 mm per metre.
inline double density_cell(double distance) {
  return std::max(0.07, 0.002 * distance);
}

}  // namespace pcl_bv::detail
