// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground's plane in one patch, given what its neighbour has found.
#pragma once

#include <cstddef>
#include <optional>

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

/// Points of a patch in a row.
struct Patch {
  const GroundPoint* points;
  std::size_t count;
  double center_u, center_v;
};

/// The plane of the lowest layer of points within `gate` metres of `expected`; none if it has too few points
/// or is steeper than `max_slope` (a tangent).
std::optional<Slope> fit_patch(const Patch& patch, const Slope& expected, double gate, double max_slope);

}  // namespace pcl_bv
