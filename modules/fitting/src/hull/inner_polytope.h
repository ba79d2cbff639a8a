// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The polytope of a cloud's extremal points. Points inside the polytope do not affect the hull (Akl,
// Toussaint 1978).
#pragma once

#include "local_frame.h"
#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/kernels/half_spaces.h"

namespace pcl_bv::detail {

/// Returns half-spaces for list_outside(). With these, list_outside() omits only points that are strictly
/// inside the convex hull of the extremal points, in spite of rounding. So list_outside() lists the extremal
/// points themselves. If the extremal points do not span a solid, the number of half-spaces is 0.
HalfSpaces inner_polytope(const PointView& points, const Supports& supports, const LocalFrame& frame);

}  // namespace pcl_bv::detail
