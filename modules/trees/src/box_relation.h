// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Decides whether a box is inside, outside or across the surface of a volume.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/kernels/region_states.h"

namespace pcl_bv {

/// Where contains() of a volume holds in a box.
enum class Relation : std::uint8_t {
  outside,   ///< For no point of the box.
  inside,    ///< For each point of the box.
  crossing,  ///< For some points only, or undecided because of rounding.
};

/// A box given by two corners, in the frame of the volume.
struct PlainBox {
  Eigen::Vector3d low, high;
};

/// Returns box k of a group in the frame of the points, rounded outward.
PlainBox plain_box(const BoxLevels& boxes, const BoxGroup& group, std::size_t k);

/// Returns the relation of a box to the region of convex_region(). Exact for RegionShape::box. For the other
/// shapes it is `crossing` also if the surface is within a margin of the box, which covers rounding: 2^-38
/// (|low|_1 + |high|_1 + |region.center|_1 + radius) + 4 doubt + 2^-480. For slabs and bodies the margin is
/// added to the distances along each axis.
Relation relation(const ConvexRegion& region, const PlainBox& box);

}  // namespace pcl_bv
