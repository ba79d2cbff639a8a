// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground's plane in one patch, given what its neighbour has found.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl_bv {

/// A place beside the sensor, and its height above it.
struct GroundPoint {
  float u, v, height;
};

/// height = offset + u * slope_u + v * slope_v
struct Slope {
  double offset, slope_u, slope_v;

  double height(double u, double v) const { return (offset + u * slope_u) + v * slope_v; }
};

/// Points of a patch, a coordinate in a row.
struct Patch {
  const float *u, *v, *height;
  std::size_t count;
  double center_u, center_v;
};

/// The plane of the lowest layer of points within `gate` metres of `expected`; none if it has too few points
/// or is steeper than `max_slope` (a tangent). `above` is room that calls share.
std::optional<Slope> fit_patch(const Patch& patch, const Slope& expected, double gate, double max_slope,
                               std::vector<double>& above);

}  // namespace pcl_bv
