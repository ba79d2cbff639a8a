// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The convex solids that the specimens of the street are assembled from.
#pragma once

#include <numbers>
#include <vector>

#include "street_model.h"

namespace pcl_bv {

enum class Axis { x, y, z };

struct Point2 {
  double u, v;
};

/// A convex outline, counter-clockwise in (u, v), drawn out along an axis from `lo` to `hi`. (u, v) is (y, z)
/// for an axis x, (x, z) for y, (x, y) for z.
Part extrude(Axis axis, const std::vector<Point2>& outline, double lo, double hi);

/// Corners on a circle, the first at its lowest v.
std::vector<Point2> regular_polygon(int corners, double radius, double u = 0, double v = 0);

Part box(const Box3& bounds);
Part ellipsoid(Vec3 center, Vec3 radii);

/// An ellipsoid of leaves, porous enough to be seen through at its rim.
Part leaves(Vec3 center, Vec3 radii);

/// Cuts away what lies beyond `point` in the direction of `normal`. The bounds stay: cut corners only.
void cut(Part& part, Vec3 normal, Vec3 point);

/// The parts as one model, with their common bounds.
Model assemble(StreetObjectKind kind, std::vector<Part> parts);

}  // namespace pcl_bv
