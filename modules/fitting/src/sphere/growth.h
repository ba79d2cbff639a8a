// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Grows a first sphere over the points that are outside of it: EXPANDSPHERE of the paper.
#pragma once

#include "local_frame.h"
#include "pcl_bv/fitting/fit.h"
#include "sphere/distance_scan.h"

namespace pcl_bv {

/// Grows the sphere of `center` and `squared_radius` (as the kernels measure) until it contains every valid
/// point by exact arithmetic.
Sphere grow_sphere(const DistanceScan& scan, const LocalFrame& frame, const Eigen::Vector3d& center,
                   double squared_radius, SphereGrowth growth);

}  // namespace pcl_bv
