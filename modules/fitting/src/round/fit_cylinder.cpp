// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>

#include "across.h"
#include "hull/hull_fit.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/small_ball.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"
#include "round/axis_search.h"

namespace pcl_bv {
namespace {

// Around an axis, in local coordinates: the smallest circle of the projections, and from where to where.
struct Around {
  Eigen::Vector3d middle;
  double squared_radius = 0;
  double height = 0;
};

Around around(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& vertices,
              std::vector<Eigen::Vector3d>& flat) {
  const Across across(axis);
  flat.clear();
  double low = dot3(axis, vertices.front()), high = low;
  for (const Eigen::Vector3d& v : vertices) {
    flat.emplace_back(dot3(across.u, v), dot3(across.v, v), 0.0);
    low = std::min(low, dot3(axis, v));
    high = std::max(high, dot3(axis, v));
  }
  const SmallBall circle = smallest_ball(flat.data(), flat.size());
  return {circle.center.x() * across.u + circle.center.y() * across.v + (low + high) / 2 * axis,
          circle.squared_radius, high - low};
}

Eigen::Vector3d find_axis(const LocalHull& hull, const std::vector<Eigen::Vector3d>& vertices) {
  if (hull.rank == 2) return hull.axes.col(2);  // a disc
  if (hull.rank < 2) return hull.axes.col(0);
  std::vector<Eigen::Vector3d> flat;
  return search_axis(hull, [&](const Eigen::Vector3d& axis) {
    const Around found = around(axis, vertices, flat);
    return found.squared_radius * found.height;
  });
}

// With q off by U = 2^-53 of itself, q . axis is off by 5 U |q|_1, |q x axis| by 15 U |q|_1, and 1 / |axis|
// by 4 U.
Cylinder measured_cylinder(const LocalHull& hull, const LocalFrame& frame, const Eigen::Vector3d& center,
                           const Eigen::Vector3d& axis) {
  double radius = 0, half_height = 0;
  for (const HullPoint& candidate : hull.candidates) {
    const Eigen::Vector3d q = frame.seen_from(center, candidate.point);
    half_height = std::max(half_height, std::abs(dot3(q, axis)) + 16 * kU * taxicab3(q));
    radius = std::max(radius, norm3(cross3(q, axis)) + 24 * kU * taxicab3(q));
  }
  return {center, axis, frame.length_up(radius), frame.length_up(half_height)};
}

}  // namespace

EstimationResult fit_cylinder(const PointView& points, Cylinder& cylinder, const Execution& execution) {
  cylinder = Cylinder();
  return fit_on_hull(points, execution, [&](const LocalHull& hull, const LocalFrame& frame, const Supports&) {
    const std::vector<Eigen::Vector3d> vertices = essential_vertices(hull);
    const Eigen::Vector3d axis = find_axis(hull, vertices);
    std::vector<Eigen::Vector3d> all, flat;
    for (const HullPoint& v : hull.vertices)
      all.push_back(v.local);
    cylinder = measured_cylinder(hull, frame, frame.global(around(axis, all, flat).middle), axis);
  });
}

}  // namespace pcl_bv
