// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Kernels that load points directly from the cloud. They are compiled as one source, because g++ 12 takes 2.4
// s per source to read Highway's templates (AMD EPYC of family 26).

#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_load.cpp"
#include <hwy/foreach_target.h>

#include "axis_extents.cpp"
#include "convert_times.cpp"
#include "deskew.cpp"
#include "half_spaces.cpp"
#include "region_states.cpp"
#include "region_subset_states.cpp"
#include "run_boxes.cpp"
#include "transform_points.cpp"

// Each source included above redefines HWY_TARGET_INCLUDE, but Highway must include this file again for the
// next instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_load.cpp"
