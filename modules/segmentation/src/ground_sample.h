// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A few thousand points that stand for the whole cloud in the search of the ground.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pcl_bv/kernels/point_view.h"
#include "pcl_bv/segmentation/ground_plane.h"

namespace pcl_bv {

/// Fills `scratch`: `sample` with up to 8192 points spread evenly over the point numbers, `support` with at
/// most 4096 of them spread evenly over the area seen from above, `lowest` with the lowest one of each of at
/// most 1024 cells of that area. They are relative to the point returned, which is in the midst of the cloud,
/// so that nothing is lost of UTM coordinates. No valid point: all empty.
Eigen::Vector3d sample_ground(const PointView& points, UpAxis up, std::uint32_t seed, GroundScratch& scratch);

}  // namespace pcl_bv
