// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The search for the axis of a cylinder or capsule over the hemisphere of directions.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "hull/local_hull.h"

namespace pcl_bv {

/// Points in local coordinates, projected onto an axis and onto the plane perpendicular to it.
struct Profile {
  /// Projects the points, and replaces the results of the call before. O(points).
  void project(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& points);

  Eigen::Vector3d foot;       ///< Centre of the points' smallest circle, in the plane through the origin.
  double squared_radius = 0;  ///< Squared radius of that circle.
  double low = 0, high = 0;   ///< Minimum and maximum projection on the axis.
  std::vector<double> projections;  ///< Projection of each point on the axis.

  /// Fills `squared`: the squared distance of each point from the line along the axis through `foot`.
  void measure_distances();
  std::vector<double> squared;

 private:
  Eigen::Vector3d middle_;
  std::vector<Eigen::Vector3d> flat_;
};

/// Returns the vertices in local coordinates; of more than 1000 only those with the minimum or maximum
/// projection along one of 49 directions. These are enough for the search, because its result is measured on
/// all points.
std::vector<Eigen::Vector3d> search_vertices(const LocalHull& hull);

/// Returns a unit vector at which `size` is small; `size` must be the same for opposite vectors. Tries 49
/// directions over the hemisphere and the hull's own axes, and improves the best by ever smaller steps. Uses
/// neither functions of libm nor random numbers.
Eigen::Vector3d search_axis(const LocalHull& hull, const std::function<double(const Eigen::Vector3d&)>& size);

}  // namespace pcl_bv
