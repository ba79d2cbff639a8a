// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/kernels/region_states.h"

namespace pcl_bv {

/// What contains() of a volume says of the points of a box.
enum class Relation : std::uint8_t {
  apart,    ///< No, of each.
  holds,    ///< Yes, of each.
  crosses,  ///< That depends; or arithmetic cannot tell.
};

/// A box by its corners, in the frame of the volume.
struct PlainBox {
  Eigen::Vector3d low, high;
};

/// Box k of a group, rounded outward.
PlainBox plain_box(const BoxLevels& boxes, const BoxGroup& group, std::size_t k);

/// For the region of convex_region(). Of all shapes but boxes `crosses` if the surface is nearer than 2^-38
/// of the taxicab lengths of the box's corners and of the region's centre, and of its radius, 4 times its
/// doubt and 2^-480 together; a body's distances along its axes are off by as much.
Relation relation(const ConvexRegion& region, const PlainBox& box);

}  // namespace pcl_bv
