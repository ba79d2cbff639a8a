// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Kernels that traverse trees. They are compiled as one source, because g++ 12 takes 2.4 s per source to read
// Highway's templates (AMD EPYC of family 26).

#include "targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_tree.cpp"
#include <hwy/foreach_target.h>

#include "tree_balls.cpp"
#include "tree_nearest.cpp"
#include "tree_swept_ball.cpp"

// Each source included above redefines HWY_TARGET_INCLUDE, but Highway must include this file again for the
// next instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels_tree.cpp"
