// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "prism_polygon.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/volumes/planar_hull.h"

namespace pcl_bv::detail {
namespace {

// Returns the part of the ray that can meet the edge between the corners i and i + 1.
std::optional<RayInterval> meeting_edge(const PrismSides& sides, std::size_t i, const PlaneRay& plane,
                                        RayClip ray) {
  const Eigen::Vector2d &a = sides.outline()[i], &b = sides.next(i), edge = sides.edge(i);
  for (int k = 0; k < 2; ++k) {
    const Projection &start = plane.origin[k], &step = plane.direction[k];
    ray.keep(step.low(), std::max(a[k], b[k]) - start.low());
    ray.keep(-step.high(), start.high() - std::min(a[k], b[k]));
  }
  const SideValue start =
      PrismSides::cross(edge, relative(plane.origin[0], a.x()), relative(plane.origin[1], a.y()));
  const SideValue step = PrismSides::cross(edge, plane.direction[0], plane.direction[1]);
  ray.keep(-step.value - 2 * step.error, start.value + 2 * start.error);
  ray.keep(step.value - 2 * step.error, -start.value + 2 * start.error);
  return ray.interval();
}

bool is_over_outline(const PrismSides& sides, const PlaneRay& plane, double t) {
  Projection at[2];
  for (int k = 0; k < 2; ++k) {
    const double moved = t * plane.direction[k].value;
    at[k].value = plane.origin[k].value + moved;
    at[k].error = 2 * (plane.origin[k].error + t * plane.direction[k].error) +
                  0x1p-50 * (std::abs(plane.origin[k].value) + std::abs(moved));
  }
  return polygon_contains(sides, at[0], at[1]);
}

}  // namespace

// Let q be the exact point, r the rounded one. Each coordinate of r is within its error of that of q. If the
// outline contains only one of the two, an edge has a point x between them, so within the errors of r. Then
// the box of the edge, widened by the errors, contains r, and the cross product of the edge with r - x is
// within the bound of PrismSides::cross(). Otherwise the exact test of r decides for both.
bool polygon_contains(const PrismSides& sides, const Projection& u, const Projection& v) {
  const Eigen::Vector2d r(u.value, v.value);
  bool inside = false;
  for (std::size_t i = 0; i < sides.outline().size(); ++i) {
    const Eigen::Vector2d &a = sides.outline()[i], &b = sides.next(i);
    if (r.y() + v.error < std::min(a.y(), b.y()) || r.y() - v.error > std::max(a.y(), b.y())) continue;
    if (r.x() + u.error >= std::min(a.x(), b.x()) && r.x() - u.error <= std::max(a.x(), b.x())) {
      const SideValue side = PrismSides::cross(sides.edge(i), relative(u, a.x()), relative(v, a.y()));
      if (std::abs(side.value) <= side.error) return true;
    }
    // Even-odd rule: an edge has its lower end, but not its upper one.
    if ((a.y() <= r.y()) == (b.y() <= r.y())) continue;
    if ((orientation(a, b, r) > 0) == (b.y() > a.y())) inside = !inside;
  }
  return inside;
}

// The ray enters or leaves the prism where it meets an edge, or at the ends of the interval to which the ray
// is already restricted.
void clip_to_polygon(const PrismSides& sides, const PlaneRay& plane, RayClip& ray) {
  const std::optional<RayInterval> whole = ray.interval();
  if (!whole) return;
  double enter = kInfinity, exit = -kInfinity;
  for (std::size_t i = 0; i < sides.outline().size(); ++i) {
    const std::optional<RayInterval> part = meeting_edge(sides, i, plane, ray);
    if (!part) continue;
    enter = std::min(enter, part->enter);
    exit = std::max(exit, part->exit);
  }
  for (const double t : {whole->enter, whole->exit}) {
    // An infinite exit means that rounding hides the slope of all three axes; treat it as above the outline.
    if (std::isfinite(t) && !is_over_outline(sides, plane, t)) continue;
    enter = std::min(enter, t);
    exit = std::max(exit, t);
  }
  ray.keep_between(enter, exit);
}

}  // namespace pcl_bv::detail
