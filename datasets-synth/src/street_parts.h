// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Functions that build convex solids and assemble them to models.
#pragma once

#include <numbers>
#include <vector>

#include "street_model.h"

namespace pcl_bv::detail {

enum class Axis { x, y, z };

struct Point2 {
  double u, v;
};

/// Extrudes a convex outline, counter-clockwise in (u, v), along an axis from `lo` to `hi`. (u, v) is (y, z)
/// for axis x, (x, z) for axis y, (x, y) for axis z.
Part extrude(Axis axis, const std::vector<Point2>& outline, double lo, double hi);

/// Returns the corners of a regular polygon about (u, v), counter-clockwise from the corner with the smallest
/// v.
std::vector<Point2> regular_polygon(int corners, double radius, double u = 0, double v = 0);

Part box(const Box3& bounds);
Part ellipsoid(Vec3 center, Vec3 radii);

/// Returns an ellipsoid of leaves. Rays near the rim often pass through the ellipsoid.
Part leaves(Vec3 center, Vec3 radii);

/// Intersects the part with the half-space normal . p <= normal . point. Does not update `part.bounds`, so
/// the bounds are exact only if the cut removes no more than corners and edges.
void cut(Part& part, Vec3 normal, Vec3 point);

/// Combines the parts to one model, whose bounds are the union of the parts' bounds.
Model assemble(SynthObjectKind kind, std::vector<Part> parts);

}  // namespace pcl_bv::detail
