// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex hull in local coordinates, which other fits use instead of all points.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hull/convex_hull.h"
#include "local_frame.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/numeric/vector3.h"
#include "point_rank.h"

namespace pcl_bv::detail {

/// A point of the cloud, as stored and in local coordinates.
struct HullPoint {
  Coordinates point;
  Eigen::Vector3d local;
  std::size_t index;  ///< Index of the point in the cloud.
};

/// The convex hull of a cloud. The inherited Span is that of the candidates, but `rank` is the rank of all
/// points.
struct LocalHull : Span {
  /// For rank 3, the vertices in ascending order of their positions in the view. For rank 2, the corners of a
  /// polygon, counter-clockwise seen from the side to which axes.col(2) points. For rank 1, the two ends. For
  /// rank 0, one point.
  std::vector<HullPoint> vertices;

  /// As ConvexHull::triangles. Empty unless the rank is 3.
  std::vector<Triangle> triangles;

  /// The extreme points of the cloud, computed in exact arithmetic, in ascending order of their positions in
  /// the view. Every valid point of the cloud is in the convex hull of the candidates. Therefore a convex set
  /// that contains the candidates contains the cloud, and a convex function has its maximum over the cloud at
  /// a candidate.
  std::vector<HullPoint> candidates;

  /// Returns the vertices in local coordinates.
  std::vector<Eigen::Vector3d> local_vertices() const {
    std::vector<Eigen::Vector3d> local;
    for (const HullPoint& vertex : vertices)
      local.push_back(vertex.local);
    return local;
  }

  /// Returns the coordinates of a point along the axes, each divided by the entry of `distances` for that
  /// axis. In these coordinates, the extent of the cloud along each axis that the cloud spans is about 1.
  Eigen::Vector3d spread(const Eigen::Vector3d& local) const {
    const Eigen::Vector3d q = local - candidates.front().local;
    return Eigen::Vector3d(dot3(axes.col(0), q), dot3(axes.col(1), q), dot3(axes.col(2), q))
        .cwiseQuotient(distances);
  }
};

/// Computes the hull of a cloud with at least one valid point. `supports` must have the set dop26 and
/// SupportDetail::points. The bits are the same for every execution. O(n) for the points inside the polytope
/// of the extremal points (Akl, Toussaint 1978), O(m log m) for the m other points. Needs a FloatEnvironment.
LocalHull local_hull(const PointView& points, const Supports& supports, const LocalFrame& frame,
                     const FitExecution& execution);

/// Returns the hull in FitExecution::supports if there is one; otherwise computes it with local_hull().
std::shared_ptr<const LocalHull> shared_hull(const PointView& points, const Supports& supports,
                                             const LocalFrame& frame, const FitExecution& execution);

}  // namespace pcl_bv::detail
