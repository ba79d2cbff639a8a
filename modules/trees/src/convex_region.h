// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts volumes to the regions that the kernel function region_states() tests.
#pragma once

#include "pcl_bv/kernels/region_states.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

/// Returns the region of a non-empty volume. If region_states() returns `inside` or `outside` for a point,
/// contains() of the volume agrees.
ConvexRegion convex_region(const AnyVolume& volume);

}  // namespace pcl_bv::detail
