// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>

#include "hull/hull_fit.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/vector3.h"
#include "round/axis_search.h"

namespace pcl_bv::detail {
namespace {

Eigen::Vector3d find_axis(const LocalHull& hull, const std::vector<Eigen::Vector3d>& vertices) {
  if (hull.rank == 2) return hull.axes.col(2);  // The cylinder of points in a plane is a disc.
  if (hull.rank < 2) return hull.axes.col(0);
  Profile profile;
  return search_axis(hull, [&](const Eigen::Vector3d& axis) {
    profile.project(axis, vertices);
    return profile.squared_radius * (profile.high - profile.low);
  });
}

// Returns the cylinder with this centre and axis around all points. q has a relative error of U = 2^-53. The
// error of q . axis is 5 U |q|_1, that of |q x axis| is 15 U |q|_1, and that of 1 / |axis| is 4 U.
Cylinder measured_cylinder(const LocalHull& hull, const LocalFrame& frame, const Eigen::Vector3d& center,
                           const Eigen::Vector3d& axis) {
  double radius = 0, half_height = 0;
  for (const HullPoint& candidate : hull.candidates) {
    const Eigen::Vector3d q = frame.relative_to(center, candidate.point);
    half_height = std::max(half_height, std::abs(dot3(q, axis)) + 16 * kUnitRoundoff * taxicab3(q));
    radius = std::max(radius, norm3(cross3(q, axis)) + 24 * kUnitRoundoff * taxicab3(q));
  }
  return {center, axis, frame.length_up(radius), frame.length_up(half_height)};
}

}  // namespace

EstimationResult fit_cylinder(const PointView& points, Cylinder& cylinder, const FitExecution& execution) {
  cylinder = Cylinder();
  return fit_on_hull(points, execution, [&](const LocalHull& hull, const LocalFrame& frame, const Supports&) {
    const std::vector<Eigen::Vector3d> vertices = search_vertices(hull);
    const Eigen::Vector3d axis = find_axis(hull, vertices);
    Profile profile;
    profile.project(axis, hull.local_vertices());
    const Eigen::Vector3d middle = profile.foot + (profile.low + profile.high) / 2 * axis;
    cylinder = measured_cylinder(hull, frame, frame.global(middle), axis);
  });
}

}  // namespace pcl_bv::detail
