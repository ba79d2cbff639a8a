// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Kernels that gather points, compiled together: to read the templates of Highway takes
// g++ 12 2.4 s (AMD EPYC of family 26) in each source.

#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_gather.cpp"
#include <hwy/foreach_target.h>

#include "moments.cpp"
#include "point_groups.cpp"
#include "slab_extents.cpp"
#include "support_own.cpp"

// Each source has set it to itself; Highway goes on with this file for the next instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_gather.cpp"
