// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex hull as other fits use it: few points instead of many, in coordinates of about 1.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hull/convex_hull.h"
#include "local_frame.h"
#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/numeric/vector3.h"
#include "point_rank.h"

namespace pcl_bv {

/// A point of the cloud, as it is stored and in local coordinates.
struct HullPoint {
  Coordinates point;
  Eigen::Vector3d local;
  std::size_t index;  ///< The cloud's number of the point.
};

/// The span is that of the candidates, its rank that of the points.
struct LocalHull : Span {
  /// Rank 3: ascending by position in the view; 2: the corners of a polygon, counter-clockwise seen from
  /// where axes.col(2) points; 1: the two ends; 0: one point.
  std::vector<HullPoint> vertices;

  /// As ConvexHull has them. Rank 3 only.
  std::vector<Triangle> triangles;

  /// The extreme points, by exact arithmetic. Every valid point of the cloud is in the hull of these: a
  /// convex set that holds them holds the cloud, and a convex function is greatest on one of them. Ascending
  /// by position in the view.
  std::vector<HullPoint> candidates;

  std::vector<Eigen::Vector3d> local_vertices() const {
    std::vector<Eigen::Vector3d> local;
    for (const HullPoint& vertex : vertices)
      local.push_back(vertex.local);
    return local;
  }

  /// A point along the axes, in units of what the candidates reach along each: coordinates of about 1 in
  /// which no cloud is thin.
  Eigen::Vector3d spread(const Eigen::Vector3d& local) const {
    const Eigen::Vector3d q = local - candidates.front().local;
    return Eigen::Vector3d(dot3(axes.col(0), q), dot3(axes.col(1), q), dot3(axes.col(2), q))
        .cwiseQuotient(reach);
  }
};

/// For a cloud with at least one valid point; `supports` are those along dop26, with points. The same bits
/// for every execution. Needs a FloatEnvironment. O(n) for the points inside the polytope of the extremal
/// ones (Akl, Toussaint 1978), O(m log m) for the m others.
LocalHull local_hull(const PointView& points, const Supports& supports, const LocalFrame& frame,
                     const Execution& execution);

/// The same, or what the execution's supports have of it.
std::shared_ptr<const LocalHull> shared_hull(const PointView& points, const Supports& supports,
                                             const LocalFrame& frame, const Execution& execution);

}  // namespace pcl_bv
