// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Point and ray queries for outlines that are not convex, conservative under rounding.
#pragma once

#include "prism_sides.h"
#include "projection.h"
#include "ray_clip.h"

namespace pcl_bv::detail {

/// Returns whether the outline contains the point (u, v). True for every point of the outline, in spite of
/// the errors of u and v. Also true for a point within the error bound of an edge.
bool polygon_contains(const PrismSides& sides, const Projection& u, const Projection& v);

/// The projections of a ray's origin and direction along the axes of the outline.
struct PlaneRay {
  Projection origin[2], direction[2];
};

/// Restricts the ray to the part from its first to its last point above the outline. The ray must be
/// restricted to the box of the outline before.
void clip_to_polygon(const PrismSides& sides, const PlaneRay& plane, RayClip& ray);

}  // namespace pcl_bv::detail
