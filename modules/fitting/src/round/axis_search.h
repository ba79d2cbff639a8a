// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The search for the axis of a cylinder or capsule: some all around, the best of them improved.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "hull/local_hull.h"

namespace pcl_bv {

/// Points in local coordinates as they are seen along an axis.
struct Profile {
  /// Takes the place of what was seen before. O(points).
  void look(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& points);

  Eigen::Vector3d foot;       ///< The middle of the smallest circle, on the plane through the origin.
  double squared_radius = 0;  ///< Of that circle.
  double low = 0, high = 0;   ///< From where to where along the axis.
  std::vector<double> along;  ///< Of each point: where.

  /// Fills `squared`: of each point the squared distance from the middle.
  void measure();
  std::vector<double> squared;

 private:
  Eigen::Vector3d middle_;
  std::vector<Eigen::Vector3d> flat_;
};

/// Local coordinates of the vertices, or where there are thousands, of those that are farthest along one of
/// 49 directions: the search needs no more, as what it finds is measured on all points.
std::vector<Eigen::Vector3d> essential_vertices(const LocalHull& hull);

/// A unit vector at which `size`, which is the same for opposite ones, is small: the best of 49 directions
/// over the hemisphere and of the hull's own axes, moved by ever smaller steps while that helps. Neither libm
/// nor chance has a part in it.
Eigen::Vector3d search_axis(const LocalHull& hull, const std::function<double(const Eigen::Vector3d&)>& size);

}  // namespace pcl_bv
