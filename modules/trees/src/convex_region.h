// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "pcl_bv/kernels/region_states.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv {

/// What contains() of a volume that is not empty says, for the kernel: `inside` there is so here, `outside`
/// too.
ConvexRegion convex_region(const AnyVolume& volume);

}  // namespace pcl_bv
