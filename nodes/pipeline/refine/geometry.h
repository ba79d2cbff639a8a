// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Small functions that the steps of the refinement share.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "pcl_bv/kernels/slab_extents.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// Returns the point at position `i` of the view.
inline Eigen::Vector3d point_at(const PointView& view, std::size_t i) {
  const Coordinates c = load_point(view, i);
  return {c.x, c.y, c.z};
}

/// Returns the box of the points of a cluster relative to its first point, along three directions (the rows
/// of `axes`, of length 1). All points must be valid.
inline Eigen::AlignedBox3d box_along(UsableIsa isa, const PointView& cluster, const Eigen::Matrix3d& axes) {
  const auto row = [&](int i) { return Direction{axes(i, 0), axes(i, 1), axes(i, 2)}; };
  const SlabExtents found = slab_extents(isa, cluster, load_point(cluster, 0), {row(0), row(1), row(2)});
  return {Eigen::Vector3d(found.low[0], found.low[1], found.low[2]),
          Eigen::Vector3d(found.high[0], found.high[1], found.high[2])};
}

/// Returns the longer of the first two sides of the box, metres. The third axis is up.
inline double plan_width(const Eigen::AlignedBox3d& box) {
  return box.sizes().head<2>().maxCoeff();
}

/// Returns the side of a cell for the density of points (PlanBasins) at this distance from the sensor,
/// metres: 7 cm, and 2 mm more for each metre beyond 35 m. Spinning LiDARs have azimuth steps of 0.1 to 0.4
/// degrees, 1.7 to 7 mm per metre.
inline double density_cell(double distance) {
  return std::max(0.07, 0.002 * distance);
}

}  // namespace pcl_bv::detail
