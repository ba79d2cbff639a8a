// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Kernels that read points as they lie in memory, compiled together: to read the templates of Highway takes
// g++ 12 2.4 s (AMD EPYC of family 26) in each source.

#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_load.cpp"
#include <hwy/foreach_target.h>

#include "axis_extents.cpp"
#include "chosen_states.cpp"
#include "half_spaces.cpp"
#include "region_states.cpp"
#include "run_boxes.cpp"

// Each source has set it to itself; Highway goes on with this file for the next instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_load.cpp"
