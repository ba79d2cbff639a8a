// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/parallel/policy.h"
#include "spatial_order.h"

namespace pcl_bv {

/// Makes room for the boxes of `items` items within the bounds, and chooses their frame.
void reset_levels(BoxLevels& boxes, std::size_t items, const PlaceBounds& bounds);

/// Sets box `item` of level 0 to one around [low, high], rounded outward.
void set_item_box(BoxLevels& boxes, std::size_t item, const Coordinates& low, const Coordinates& high);

/// Sets the boxes of all levels but 0 from those below. O(items / 16), in the calling thread.
void raise_levels(BoxLevels& boxes);

/// Sets least_reached from the boxes. O(items), in the calling thread.
void find_least_reached(BoxLevels& boxes);

}  // namespace pcl_bv
