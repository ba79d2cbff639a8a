// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The farthest points of a whole cloud along directions given at run time, without an allocation for small
// clouds.
#pragma once

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/kernels/projections.h"

namespace pcl_bv {

/// As chunk_farthest() for all chunks, over the cores. The same bits for every execution. Needs a
/// FloatEnvironment.
ChunkFarthest find_farthest(const PointView& points, const ProjectionSet& set, const Execution& execution);

}  // namespace pcl_bv
