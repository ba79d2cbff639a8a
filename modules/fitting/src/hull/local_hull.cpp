// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "hull/local_hull.h"

#include <algorithm>

#include "hull/convex_hull.h"
#include "hull/inner_polytope.h"
#include "map_chunks.h"
#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/volumes/planar_hull.h"
#include "same_points.h"
#include "schedule.h"

namespace pcl_bv::detail {
namespace {

// For at most this number of points the polytope takes more time than it saves. With 300 points of a
// Gaussian, the hull takes 118 us without the polytope and 194 us with the polytope (AVX-512).
constexpr std::size_t kFewPoints = 500;

// If a chunk of a source has more candidates than this, only its extreme points are stored. If all chunks
// together have more than 8 times this number, only the extreme points of all chunks are stored. For points
// in memory, all candidates are stored, because these take only a few times the memory of the points.
// Furthermore, on a smooth surface all points are extreme, so computing the extreme points of the chunks
// first would drop no point.
constexpr std::size_t kManyPoints = 1 << 12;

std::vector<HullPoint> find_candidates(const PointView& points, const HalfSpaces& inside,
                                       const LocalFrame& frame, const FitExecution& execution) {
  std::vector<HullPoint> all;
  const bool held = points.source == nullptr;
  std::size_t most = kManyPoints * 8;
  const auto list = [&](const PointView& chunk) {
    std::vector<std::uint32_t> positions(chunk.count);
    positions.resize(list_outside(execution.isa, chunk, inside, positions.data()));
    std::vector<HullPoint> found;
    found.reserve(positions.size());
    for (const std::uint32_t i : positions) {
      const Coordinates p = load_point(chunk, i);
      if (is_valid(p)) found.push_back({p, frame.local(p), chunk.index(i)});
    }
    if (!held && found.size() > kManyPoints) keep_extreme(found);
    return found;
  };
  const auto append = [&](std::vector<HullPoint>&& part) {
    const std::vector<HullPoint> found = std::move(part);
    all.insert(all.end(), found.begin(), found.end());
    if (held || all.size() <= most) return;
    keep_extreme(all);
    most = std::max(most, 2 * all.size());
  };
  map_chunks<std::vector<HullPoint>, 16>(points, worthwhile(execution, Work::half_spaces, points.count), list,
                                         append);
  return all;
}

// Returns the box of the candidates. It is also the box of all points, because the other points are strictly
// inside the hull and therefore not on a side of the box.
Aabb box_of(const std::vector<HullPoint>& candidates) {
  Aabb box;
  for (const HullPoint& candidate : candidates)
    box.extend(vector(candidate.point));
  return box;
}

void keep_vertices(const std::vector<std::size_t>& positions, LocalHull& hull) {
  for (const std::size_t i : positions)
    hull.vertices.push_back(hull.candidates[i]);
}

// Finds the corners of a flat hull. Projects the points by dropping the coordinate in which the normal of the
// plane has its largest component. Such a projection has no rounding errors.
void find_polygon(LocalHull& hull) {
  Eigen::Index dropped = 0;
  hull.axes.col(2).cwiseAbs().maxCoeff(&dropped);
  const Eigen::Index u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  std::vector<Eigen::Vector2d> flat;
  for (const HullPoint& candidate : hull.candidates)
    flat.emplace_back(candidate.local[u], candidate.local[v]);
  std::vector<std::size_t> corners = planar_hull(flat);
  if (hull.axes(dropped, 2) < 0) std::reverse(corners.begin() + 1, corners.end());
  keep_vertices(corners, hull);
}

void find_ends(LocalHull& hull) {
  std::size_t low = 0, high = 0;
  const auto along = [&](std::size_t i) { return dot3(hull.axes.col(0), hull.candidates[i].local); };
  for (std::size_t i = 1; i < hull.candidates.size(); ++i) {
    if (along(i) < along(low)) low = i;
    if (along(i) > along(high)) high = i;
  }
  keep_vertices({low, high}, hull);
}

}  // namespace

LocalHull local_hull(const PointView& points, const Supports& supports, const LocalFrame& frame,
                     const FitExecution& execution) {
  LocalHull hull;
  HalfSpaces inside;
  if (supports.used > kFewPoints) inside = inner_polytope(points, supports, frame);
  hull.candidates = find_candidates(points, inside, frame, execution);
  require_same_points(box_of(hull.candidates) == aabb_of(supports));
  hull.triangles = keep_extreme(hull.candidates);
  const PointView view =
      PointView::of(&hull.candidates.front().point.x, sizeof(HullPoint), hull.candidates.size());
  static_cast<Span&>(hull) = span_of(view, frame.scale(), execution);
  hull.rank = supports.rank;
  if (hull.rank < 3) hull.triangles.clear();
  switch (hull.rank) {
    case 3:
      hull.vertices = hull.candidates;
      require_same_points(!hull.triangles.empty());
      break;
    case 2:
      find_polygon(hull);
      break;
    case 1:
      find_ends(hull);
      break;
    default:
      keep_vertices({0}, hull);
  }
  return hull;
}

std::shared_ptr<const LocalHull> shared_hull(const PointView& points, const Supports& supports,
                                             const LocalFrame& frame, const FitExecution& execution) {
  if (execution.supports != nullptr && execution.supports->hull) return execution.supports->hull;
  return std::make_shared<LocalHull>(local_hull(points, supports, frame, execution));
}

}  // namespace pcl_bv::detail
