// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The scalar references of extremes.cpp and axis_extents.cpp: what their vectors must agree with.
#pragma once

#include "pcl_bv/kernels/axis_extents.h"
#include "pcl_bv/kernels/extremes.h"

namespace pcl_bv {

void chunk_extremes_reference(const PointView& chunk, DirectionSet set, const ReachedEnds& reached,
                              ChunkExtremes& out);
AxisExtents axis_extents_reference(const PointView& points);

}  // namespace pcl_bv
