// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The terms of a sum may be added in any order in this file, because the margins are a thousand times the
// rounding errors.

#include "box_relation.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/vector3.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

// The half extents of a box and its centre relative to the centre of the region, with an error bound for
// comparisons.
struct CenteredBox {
  Eigen::Vector3d center, half;
  double margin;

  CenteredBox(const ConvexRegion& region, const PlainBox& box)
      : center(0.5 * (box.low + box.high) - vector(region.center)), half(0.5 * (box.high - box.low)) {
    const double size = taxicab3(box.low) + taxicab3(box.high) + taxicab3(region.center);
    margin = 0x1p-38 * (size + region.radius) + 4 * region.surface_error + 0x1p-480;
  }

  double along(const Direction& n) const { return dot3(n, center); }
  double half_width(const Direction& n) const {
    return std::abs(n[0]) * half[0] + std::abs(n[1]) * half[1] + std::abs(n[2]) * half[2];
  }
};

Relation relation_to_sides(const ConvexRegion& region, const PlainBox& box) {
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (box.low[k] > region.high[axis] || box.high[k] < region.low[axis]) return Relation::outside;
    inside = inside && box.low[k] >= region.low[axis] && box.high[k] <= region.high[axis];
  }
  return inside ? Relation::inside : Relation::crossing;
}

Relation relation_to_planes(const ConvexRegion& region, const CenteredBox& box) {
  bool inside = true;
  for (const HalfSpace& plane : region.planes) {
    const Direction n = {plane.x, plane.y, plane.z};
    const double at = box.along(n), half_width = box.half_width(n);
    if (at - half_width > plane.limit + box.margin) return Relation::outside;
    inside = inside && at + half_width < plane.limit - box.margin;
  }
  return inside ? Relation::inside : Relation::crossing;
}

Relation relation_to_ball(const ConvexRegion& region, const CenteredBox& box) {
  const Eigen::Vector3d at = box.center.cwiseAbs();
  const double nearest = (at - box.half).cwiseMax(0).norm(), farthest = (at + box.half).norm();
  if (nearest > region.radius + box.margin) return Relation::outside;
  return farthest < region.radius - box.margin ? Relation::inside : Relation::crossing;
}

double weighted_square(double weight, double beyond) {
  return beyond > 0 ? weight * beyond * weight * beyond : 0;  // a weight may be infinite; infinity * 0 is NaN
}

// Returns the relation for RegionShape::slabs and RegionShape::rounded. Along each axis of the region,
// compares the smallest and the largest distance of the box from the centre with the extent of the region.
Relation relation_to_body(const ConvexRegion& region, const CenteredBox& box) {
  bool inside = true;
  double smallest = 0, largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = std::abs(box.along(region.axes[i])), half_width = box.half_width(region.axes[i]);
    const double near = at - half_width - box.margin, far = at + half_width + box.margin;
    if (near > region.slab[i]) return Relation::outside;
    inside = inside && far < region.slab[i];
    smallest += weighted_square(region.weight[i], near - region.core[i]);
    largest += weighted_square(region.weight[i], far - region.core[i]);
  }
  if (region.shape == RegionShape::slabs) return inside ? Relation::inside : Relation::crossing;
  const double square = region.radius * region.radius;
  if (smallest > square) return Relation::outside;
  return inside && largest < square ? Relation::inside : Relation::crossing;
}

}  // namespace

PlainBox plain_box(const BoxLevels& boxes, const BoxGroup& group, std::size_t k) {
  PlainBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double low = group.low[axis][k] / boxes.scale, high = group.high[axis][k] / boxes.scale;
    box.low[axis] = boxes.origin[a] + low;
    box.high[axis] = boxes.origin[a] + high;
    box.low[axis] -= 0x1p-52 * std::abs(box.low[axis]);
    box.high[axis] += 0x1p-52 * std::abs(box.high[axis]);
  }
  return box;
}

Relation relation(const ConvexRegion& region, const PlainBox& box) {
  switch (region.shape) {
    case RegionShape::box:
      return relation_to_sides(region, box);
    case RegionShape::planes:
      return relation_to_planes(region, {region, box});
    case RegionShape::ball:
      return relation_to_ball(region, {region, box});
    default:
      return relation_to_body(region, {region, box});
  }
}

}  // namespace pcl_bv::detail
