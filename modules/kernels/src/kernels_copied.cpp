// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Kernels that copy points to groups or blocks first, compiled as one source: reading Highway's templates
// takes g++ 12 2.4 s per source (AMD EPYC of family 26).

#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_copied.cpp"
#include <hwy/foreach_target.h>

#include "moments.cpp"
#include "point_groups.cpp"
#include "slab_extents.cpp"
#include "support_general.cpp"

// Each included source redefines this macro; Highway must include this file again for the next instruction
// set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_copied.cpp"
