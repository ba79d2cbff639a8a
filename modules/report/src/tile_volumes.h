// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The values of "boundingVolume" of 3D Tiles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "json_text.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

/// Returns the numbers of a "box": the center and the half axes.
inline Eigen::Matrix<double, 12, 1> tile_numbers(const Obb& box) {
  const Eigen::Matrix3d half = box.axes() * box.half_extents().asDiagonal();
  Eigen::Matrix<double, 12, 1> twelve;
  twelve << box.center(), half.col(0), half.col(1), half.col(2);
  return twelve;
}

/// Returns the numbers of a "sphere".
inline std::array<double, 4> tile_numbers(const Sphere& sphere) {
  const Eigen::Vector3d& c = sphere.center();
  return {c.x(), c.y(), c.z(), sphere.radius()};
}

// Returns degrees in radians, rounded down. The product has an error of half a unit in the last place, and
// the constant adds 0.16 of a unit, so one step down is enough. `largest` is the double nearest to pi or pi /
// 2, because validators of tilesets allow no more.
inline double radians_below(double degrees, double largest) {
  if (degrees == 0) return 0;
  const double nearest = degrees * (M_PI / 180);
  return std::max(-largest, std::nextafter(nearest, -HUGE_VAL));
}

/// Adds the region of a box whose x and y are longitudes and latitudes in degrees.
inline void add_tile_region(const Aabb& box, JsonText& json) {
  const Eigen::Vector3d &low = box.min(), &high = box.max();
  const std::array region{radians_below(low.x(), M_PI),
                          radians_below(low.y(), M_PI_2),
                          -radians_below(-high.x(), M_PI),
                          -radians_below(-high.y(), M_PI_2),
                          low.z(),
                          high.z()};
  json.begin('{').add("region", region).end('}');
}

}  // namespace pcl_bv::detail
