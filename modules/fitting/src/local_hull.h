// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex hull as other fits use it: few points instead of many, in coordinates of about 1.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hull_triangles.h"
#include "local_frame.h"
#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/extremes.h"

namespace pcl_bv {

/// A point of the cloud, as it is stored and in local coordinates.
struct HullPoint {
  Coordinates point;
  Eigen::Vector3d local;
  std::size_t index;  ///< The cloud's number of the point.
};

struct LocalHull {
  /// 0: all points are equal, 1: on a line, 2: in a plane, all to within 2^-36 of the extent; else 3.
  int rank = 0;

  /// Orthonormal. Of rank 2: columns 0 and 1 span the plane; of rank 1: column 0 is along the line.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  /// Rank 3: ascending by position in the view; 2: the corners of a polygon, counter-clockwise seen from
  /// where axes.col(2) points; 1: the two ends; 0: one point.
  std::vector<HullPoint> vertices;

  /// Numbers of vertices, counter-clockwise seen from outside. Rank 3 only.
  std::vector<Triangle> triangles;

  /// All points that are not proven to be strictly inside the hull of others. Every valid point of the cloud
  /// is, by exact arithmetic, in the hull of these: a convex set that holds them holds the cloud, and a
  /// convex function is greatest on one of them. Ascending by position in the view.
  std::vector<HullPoint> candidates;
};

/// For a cloud with at least one valid point; `extremes` are those along dop26, with points. The same bits
/// for every execution. `vertices` and `triangles` are the hull up to rounding (hull_triangles.h);
/// `candidates` are exact. Throws std::runtime_error if Qhull fails on points that span three dimensions.
/// Needs a FloatEnvironment. O(n) for the points inside the polytope of the extremal ones, O(m log m) for the
/// m others.
LocalHull local_hull(const PointView& points, const Extremes& extremes, const LocalFrame& frame,
                     const Execution& execution);

}  // namespace pcl_bv
