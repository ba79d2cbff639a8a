// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Decides whether a box is inside a volume, outside of it or crosses its surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/kernels/region_states.h"

namespace pcl_bv::detail {

/// The points of a box for which contains() of a volume holds.
enum class Relation : std::uint8_t {
  outside,   ///< contains() holds for no point of the box.
  inside,    ///< contains() holds for each point of the box.
  crossing,  ///< contains() holds for some points only, or the test leaves the relation open.
};

/// A box given by two corners, in the frame of the volume.
struct PlainBox {
  Eigen::Vector3d low, high;
};

/// Returns box k of a group, in the frame of the points, rounded outward.
PlainBox plain_box(const BoxLevels& boxes, const BoxGroup& group, std::size_t k);

/// Returns the relation of a box to the region of convex_region(). The relation is exact for
/// RegionShape::box. For the other shapes, the relation is also `crossing` in two cases. The first case is a
/// box within a margin of the surface. The margin covers rounding. It is 2^-38 (|low|_1 + |high|_1 +
/// |region.center|_1 + region.radius) + 4 region.surface_error + 2^-480. The second case is a box outside
/// near an edge or corner of the region, because only the axes and planes of the region are tested.
Relation relation(const ConvexRegion& region, const PlainBox& box);

}  // namespace pcl_bv::detail
