// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A SIMD filter drops the points inside the polygon of the extremal points seen from above. The convex hull
// of the other points is computed in exact arithmetic. A concave outline then needs all points again.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "box/outline.h"
#include "map_chunks.h"
#include "pcl_bv/fitting/fit_into.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/coordinate_axis.h"
#include "pcl_bv/volumes/planar_hull.h"
#include "pcl_bv/volumes/simple_polygon.h"
#include "prism/concave_outline.h"
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

// Returns the rounded coordinates (u, v) of all points.
std::vector<Eigen::Vector2d> projected_points(const PointView& points, const Supports& supports,
                                              const GroundProjection& projection,
                                              const FitExecution& execution) {
  using Positions = std::vector<Eigen::Vector2d>;
  Positions all;
  map_chunks<Positions, 16>(
      points, worthwhile(execution, Work::outline, points.count),
      [&](const PointView& chunk) {
        Positions found;
        found.reserve(chunk.count);
        for (std::size_t i = 0; i < chunk.count; ++i) {
          const Coordinates p = load_point(chunk, i);
          if (!is_valid(p)) continue;
          require_same_points(within(supports, p));
          found.emplace_back(projection.project(p).at.array() + 0.0);
        }
        return found;
      },
      [&](Positions part) {
        if (all.empty()) {
          all = std::move(part);
        } else {
          all.insert(all.end(), part.begin(), part.end());
        }
      });
  require_same_points(all.size() == supports.used);
  return all;
}

// Returns a power of two by which coordinates are multiplied, so that squares of lengths do not underflow.
double scale_of(const ProjectedPoints& corners) {
  double largest = 0;
  for (const ProjectedPoint& corner : corners)
    largest = std::max(largest, corner.at.cwiseAbs().maxCoeff());
  return largest < 0x1p-300 ? unit_scale(largest) : 1;
}

// Returns whether an edge of the convex hull is longer than a length. Both are multiplied by `scale`, which
// is scale_of().
bool has_longer_edge(const ProjectedPoints& corners, double length, double scale) {
  const double scaled_length = length * scale;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d edge = corners[i + 1 < corners.size() ? i + 1 : 0].at - corners[i].at;
    if ((edge * scale).squaredNorm() > scaled_length * scaled_length) return true;
  }
  return false;
}

void multiply(std::vector<Eigen::Vector2d>& points, double scale) {
  for (Eigen::Vector2d& point : points)
    point *= scale;
}

// Returns a concave outline around all points. Returns nothing if the convex one has no edge to replace, or
// if none remains after polygon_around() has moved the edges outward by the error bound, by which the rounded
// coordinates differ from the exact ones at most.
std::optional<std::vector<Eigen::Vector2d>> concave_outline_of(const PointView& points,
                                                               const Supports& supports,
                                                               const ProjectedPoints& corners,
                                                               const GroundProjection& projection,
                                                               double length, const FitExecution& execution) {
  const double scale = scale_of(corners);
  if (!(length < kInfinity) || !has_longer_edge(corners, length, scale)) return std::nullopt;
  std::vector<Eigen::Vector2d> all = projected_points(points, supports, projection, execution);
  std::vector<Eigen::Vector2d> hull;
  if (projection.is_exact()) {
    hull = outline_of(corners, projection);
  } else {
    for (const std::size_t i : planar_hull(all))
      hull.push_back(all[i]);
  }
  if (hull.size() < 3) return std::nullopt;
  multiply(hull, scale);
  multiply(all, scale);
  std::vector<Eigen::Vector2d> outline = concave_outline(hull, all, length * scale);
  if (outline == hull) return std::nullopt;
  multiply(outline, 1 / scale);
  std::optional<std::vector<Eigen::Vector2d>> around = polygon_around(outline, projection.error_bound());
  if (around && is_strictly_convex(*around)) return std::nullopt;
  return around;
}

double checked_length(double length) {
  if (length > 0) return length;
  char digits[32];
  const std::string text(digits, std::to_chars(digits, digits + sizeof digits, length).ptr);
  throw std::invalid_argument("fit_prism: concave_length " + text + " is not above 0");
}

struct Heights {
  double low, high;
};

// Returns the exact minimum and maximum of up . p, rounded outward.
Heights heights_of(const PointView& points, const Supports& supports, const Eigen::Vector3d& up,
                   const FitExecution& execution) {
  if (const std::optional<int> k = coordinate_axis(up)) {
    const Support& along = supports.along[*k];
    if (up[*k] > 0) return {along.low, along.high};
    return {0.0 - along.high, 0.0 - along.low};
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
  const double length = checked_length(options.concave_length);
  if (length < kInfinity) require_all_points(execution, kConcavePrism);
  const Supports supports = find_supports(points, DirectionSet::dop26, SupportDetail::points, execution);
  if (supports.used > 0) {
    const Ground ground(up);
    const GroundProjection projection(ground, supports);
    const ProjectedPoints corners = corners_from_above(points, supports, ground, projection, execution);
    const Heights heights = heights_of(points, supports, ground.up, execution);
    Eigen::Matrix3d axes;
    axes << ground.east, ground.north, ground.up;
    auto concave = concave_outline_of(points, supports, corners, projection, length, execution);
    const bool is_convex = !concave;
    prism = PrismAccess::make(axes.array() + 0.0,
                              is_convex ? outline_of(corners, projection) : *std::move(concave),
                              heights.low + 0.0, heights.high + 0.0, is_convex);
  }
  return result_of(supports);
}

}  // namespace pcl_bv::detail
