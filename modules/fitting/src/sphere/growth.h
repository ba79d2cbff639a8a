// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Grows a first sphere over the points outside of it (EXPANDSPHERE in the paper).
#pragma once

#include "local_frame.h"
#include "pcl_bv/fitting/fit_into.h"
#include "sphere/distance_scan.h"

namespace pcl_bv::detail {

/// Grows the sphere with this centre and squared radius until it contains every valid point in exact
/// arithmetic. `squared_radius` is in the squared unit of the distance kernels (LocalFrame::center()).
Sphere grow_sphere(const DistanceScan& scan, const LocalFrame& frame, const Eigen::Vector3d& center,
                   double squared_radius, SphereGrowth growth);

}  // namespace pcl_bv::detail
