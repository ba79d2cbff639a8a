// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The scalar reference of projections.cpp: what its vectors must agree with.
#pragma once

#include "pcl_bv/kernels/projections.h"

namespace pcl_bv {

void chunk_farthest_reference(const PointView& chunk, const ProjectionSet& set,
                              const ReachedProjections& reached, ChunkFarthest& out);

}  // namespace pcl_bv
