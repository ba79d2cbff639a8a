// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Functions that build convex solids and assemble them to models.
#include "street_parts.h"

#include <algorithm>
#include <utility>

namespace pcl_bv::detail {
namespace {

Vec3 along(Axis axis, double u, double v, double w) {
  if (axis == Axis::x) return {w, u, v};
  if (axis == Axis::y) return {u, w, v};
  return {u, v, w};
}

Box3 merged(const Box3& a, const Box3& b) {
  return {{std::min(a.lo.x, b.lo.x), std::min(a.lo.y, b.lo.y), std::min(a.lo.z, b.lo.z)},
          {std::max(a.hi.x, b.hi.x), std::max(a.hi.y, b.hi.y), std::max(a.hi.z, b.hi.z)}};
}

}  // namespace

Part extrude(Axis axis, const std::vector<Point2>& outline, double lo, double hi) {
  Part part;
  part.bounds = {along(axis, outline[0].u, outline[0].v, lo), along(axis, outline[0].u, outline[0].v, hi)};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point2 a = outline[i];
    const Point2 b = outline[(i + 1) % outline.size()];
    cut(part, along(axis, b.v - a.v, a.u - b.u, 0), along(axis, a.u, a.v, lo));
    part.bounds = merged(part.bounds, {along(axis, a.u, a.v, lo), along(axis, a.u, a.v, hi)});
  }
  cut(part, along(axis, 0, 0, -1), along(axis, 0, 0, lo));
  cut(part, along(axis, 0, 0, 1), along(axis, 0, 0, hi));
  return part;
}

std::vector<Point2> regular_polygon(int corners, double radius, double u, double v) {
  std::vector<Point2> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners - 0.5 * std::numbers::pi;
    outline.push_back({u + radius * std::cos(angle), v + radius * std::sin(angle)});
  }
  return outline;
}

Part box(const Box3& bounds) {
  const auto [lo, hi] = bounds;
  return extrude(Axis::z, {{lo.x, lo.y}, {hi.x, lo.y}, {hi.x, hi.y}, {lo.x, hi.y}}, lo.z, hi.z);
}

Part ellipsoid(Vec3 center, Vec3 radii) {
  Part part;
  part.bounds = {center - radii, center + radii};
  return part;
}

Part leaves(Vec3 center, Vec3 radii) {
  Part part = ellipsoid(center, radii);
  part.free_path = 0.35;
  return part;
}

void cut(Part& part, Vec3 normal, Vec3 point) {
  const Vec3 unit = normalized(normal);
  part.half_spaces.push_back({unit, dot(unit, point)});
}

Model assemble(SynthObjectKind kind, std::vector<Part> parts) {
  Box3 bounds = parts.at(0).bounds;
  for (const Part& part : parts)
    bounds = merged(bounds, part.bounds);
  return {kind, std::move(parts), bounds};
}

}  // namespace pcl_bv::detail
