// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Kernels that copy points to groups or blocks first. They are compiled as one source, because g++ 12 takes
// 2.4 s per source to read Highway's templates (AMD EPYC of family 26).

#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_copied.cpp"
#include <hwy/foreach_target.h>

#include "moments.cpp"
#include "point_groups.cpp"
#include "slab_extents.cpp"
#include "support_general.cpp"

// Each source included above redefines HWY_TARGET_INCLUDE, but Highway must include this file again for the
// next instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_copied.cpp"
