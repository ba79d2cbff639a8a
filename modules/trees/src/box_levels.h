// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Builds the levels of boxes (BoxLevels) of a tree.
#pragma once

#include <cstddef>

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/parallel/execution.h"
#include "spatial_order.h"

namespace pcl_bv::detail {

/// Allocates the boxes of `items` items inside `bounds`. Chooses the frame (origin and scale) of the boxes.
void reset_levels(BoxLevels& boxes, std::size_t items, const PositionBounds& bounds);

/// Sets box `item` of level 0 to a box around [low, high], rounded outward.
void set_item_box(BoxLevels& boxes, std::size_t item, const Coordinates& low, const Coordinates& high);

/// Sets the boxes of level 1 and above from the levels below. O(items / 16), on the calling thread.
void raise_levels(BoxLevels& boxes);

/// Sets BoxLevels::min_side_radius from the boxes. O(items), on the calling thread.
void find_min_side_radii(BoxLevels& boxes);

}  // namespace pcl_bv::detail
