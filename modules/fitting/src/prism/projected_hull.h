// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The exact convex hull of points seen from above.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "box/outline.h"
#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/volumes/outline.h"
#include "small_vector.h"

namespace pcl_bv::detail {

/// A point and its rounded coordinates (east . p, north . p) on the ground.
struct ProjectedPoint {
  Coordinates point;
  Eigen::Vector2d at;
};

/// Projects points on a ground and finds their convex hull. The hull is that of the exact coordinates, even
/// where these are no doubles.
class GroundProjection {
 public:
  /// `supports` must be those of the cloud to which all points belong.
  GroundProjection(const Ground& ground, const Supports& supports);

  ProjectedPoint project(const Coordinates& p) const;

  /// Whether the coordinates of all points are doubles, because the axes of the ground are coordinate axes.
  bool is_exact() const { return error_bound_ == 0; }

  /// Bound of the rounding errors of the coordinates of project(); 0 if is_exact().
  double error_bound() const { return error_bound_; }

  /// Keeps the corners of the convex hull, counter-clockwise, beginning with the smallest (u, v). Of points
  /// with equal coordinates one remains. O(n log n).
  void keep_corners(std::vector<ProjectedPoint>& points) const;

  /// Returns the smallest box of doubles that contains the exact coordinates of a point.
  PlaneBox box(const Coordinates& p) const;

 private:
  int compare(const ProjectedPoint& a, const ProjectedPoint& b, int axis) const;
  int turn(const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& c) const;
  int exact_turn(const Coordinates& a, const Coordinates& b, const Coordinates& c) const;

  Eigen::Vector3d axes_[2];
  SmallVector<double, 4> normal_[3];  // terms whose exact sums are the components of axes_[0] x axes_[1]
  bool has_exact_normal_ = true;      // whether normal_ is exact
  double scale_;                      // for exact_turn()
  double error_bound_ = 0;            // of the rounded coordinates
};

}  // namespace pcl_bv::detail
