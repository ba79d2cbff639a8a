// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The search for the axis of a cylinder or capsule over the hemisphere of directions.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "hull/local_hull.h"

namespace pcl_bv::detail {

/// Points in local coordinates, projected onto an axis through the origin and onto the plane through the
/// origin that is perpendicular to the axis.
struct Profile {
  /// Projects the points, and replaces the results of the previous call of project(). O(points).
  void project(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& points);

  Eigen::Vector3d foot;       ///< Centre of the smallest circle around the points in the plane.
  double squared_radius = 0;  ///< Squared radius of that circle.
  double low = 0, high = 0;   ///< Minimum and maximum projection on the axis.
  std::vector<double> projections;  ///< Projection of each point on the axis.

  /// Fills `squared`.
  void measure_distances();
  std::vector<double> squared;  ///< Squared distance of each point from the axis line through `foot`.

 private:
  Eigen::Vector3d middle_;
  std::vector<Eigen::Vector3d> flat_;
};

/// Returns the vertices in local coordinates. Of more than 1000 vertices it returns only those with the
/// minimum or maximum projection along one of 49 directions. With fewer vertices the found axis may be
/// slightly worse, but the volume still encloses all points, because it is measured on all points.
std::vector<Eigen::Vector3d> search_vertices(const LocalHull& hull);

/// Returns a unit vector for which size() is small. size() must return the same for opposite vectors. The
/// search tries the axes of the hull and 49 directions over the hemisphere. It improves the best of these by
/// smaller and smaller steps. The bits are the same on every machine: the search uses no random numbers and
/// no function of libm except the square root, whose rounding IEEE 754 defines.
Eigen::Vector3d search_axis(const LocalHull& hull, const std::function<double(const Eigen::Vector3d&)>& size);

}  // namespace pcl_bv::detail
