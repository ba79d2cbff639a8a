// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A SIMD filter drops the points inside the polygon of the extremal points seen from above. The convex hull
// of the other points is computed in exact arithmetic.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "box/outline.h"
#include "map_chunks.h"
#include "pcl_bv/fitting/fit_into.h"
#include "prism/projected_hull.h"
#include "same_points.h"
#include "schedule.h"
#include "support/support_search.h"

namespace pcl_bv::detail {
namespace {

using ProjectedPoints = std::vector<ProjectedPoint>;

// Throws std::invalid_argument if the corners do not extend as far as the supports. If `up` is a coordinate
// axis, points with the smallest and the largest coordinate along each other axis are corners.
void require_same_extents(const ProjectedPoints& corners, const Supports& supports,
                          const Eigen::Vector3d& up) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (up[static_cast<int>(k)] != 0) continue;
    const auto before = [k](const ProjectedPoint& a, const ProjectedPoint& b) {
      return a.point[k] < b.point[k];
    };
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), before);
    require_same_points(low->point[k] == supports.along[k].low && high->point[k] == supports.along[k].high);
  }
}

ProjectedPoints corners_from_above(const PointView& points, const Supports& supports, const Ground& ground,
                                   const GroundProjection& projection, const FitExecution& execution) {
  const LocalFrame frame(supports);
  const HalfSpaces inside = outline_half_spaces(points, supports, frame, ground);
  ProjectedPoints corners;
  std::size_t most = std::size_t{1} << 16;
  map_chunks<ProjectedPoints, 16>(
      points, worthwhile(execution, Work::outline, points.count),
      [&](const PointView& chunk) {
        ProjectedPoints found;
        found.reserve(std::min<std::size_t>(chunk.count, 256));
        for_each_outside(execution.isa, chunk, supports, inside,
                         [&](const Coordinates& p) { found.push_back(projection.project(p)); });
        projection.keep_corners(found);
        return found;
      },
      [&](const ProjectedPoints& part) {
        corners.insert(corners.end(), part.begin(), part.end());
        if (corners.size() <= most) return;
        projection.keep_corners(corners);
        most = std::max(most, 2 * corners.size());
      });
  require_same_points(!corners.empty());
  if (chunk_count(points.count) > 1) projection.keep_corners(corners);
  if (projection.is_exact()) require_same_extents(corners, supports, ground.up);
  return corners;
}

std::vector<Eigen::Vector2d> outline_of(const ProjectedPoints& corners, const GroundProjection& projection) {
  std::vector<Eigen::Vector2d> outline;
  if (projection.is_exact()) {
    for (const ProjectedPoint& corner : corners)
      outline.emplace_back(corner.at.array() + 0.0);
    return outline;
  }
  std::vector<PlaneBox> boxes;
  for (const ProjectedPoint& corner : corners)
    boxes.push_back(projection.box(corner.point));
  return outline_around(boxes);
}

struct Heights {
  double low, high;
};

// Returns the exact minimum and maximum of up . p, rounded outward.
Heights heights_of(const PointView& points, const Supports& supports, const Eigen::Vector3d& up,
                   const FitExecution& execution) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Support& along = supports.along[k];
    if (up == Eigen::Vector3d::Unit(static_cast<int>(k))) return {along.low, along.high};
    if (-up == Eigen::Vector3d::Unit(static_cast<int>(k))) return {0.0 - along.high, 0.0 - along.low};
  }
  SupportDirections directions;
  directions.add({up.x(), up.y(), up.z()});
  SupportSearch search(execution.isa, directions, points.count);
  search.run(points, execution);
  require_same_points(supports.moments || search.dropped() == supports.dropped);
  const Support along = search.along(0);
  return {along.low, along.high};
}

}  // namespace

EstimationResult fit_prism(const PointView& points, const PrismOptions& options, Prism& prism,
                           const FitExecution& execution) {
  prism = Prism();
  const Eigen::Vector3d up = unit_up("fit_prism", options.up);
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, execution);
  if (supports.used > 0) {
    const Ground ground(up);
    const GroundProjection projection(ground, supports);
    const ProjectedPoints corners = corners_from_above(points, supports, ground, projection, execution);
    const Heights heights = heights_of(points, supports, ground.up, execution);
    Eigen::Matrix3d axes;
    axes << ground.east, ground.north, ground.up;
    prism = PrismAccess::make(axes.array() + 0.0, outline_of(corners, projection), heights.low + 0.0,
                              heights.high + 0.0);
  }
  return result_of(supports);
}

}  // namespace pcl_bv::detail
