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

/// For the region of convex_region(). Exact for boxes. For all other shapes `crosses` also where the surface
/// is within a margin of the box, which covers rounding: 2^-38 (|low|_1 + |high|_1 + |region.center|_1 +
/// radius) + 4 doubt + 2^-480. Of slabs and bodies it is added to the distances along each axis.
Relation relation(const ConvexRegion& region, const PlainBox& box);

}  // namespace pcl_bv
