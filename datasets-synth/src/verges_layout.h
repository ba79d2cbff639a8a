// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where the objects beside and on the road are, in the fixed frame.
#pragma once

#include <cstdint>
#include <vector>

#include "street_layout.h"
#include "verges_world.h"

namespace pcl_bv::verges {

struct VergesPlaced {
  PlacedObject object;  ///< In the fixed frame, and so its velocity.
  double yaw_rate = 0;  ///< rad/s
};

/// Those within 130 m of the sensor's car, by ascending id.
std::vector<VergesPlaced> place_verges(const World& world, std::uint64_t seed, double seconds);

/// The place and axes of something on the road: forward along it, up as the ground.
PlacedObject on_road(const World& world, const RoadPlace& place, bool backward, bool tilted);

inline constexpr double own_lane = -1.75;  ///< Metres left of the middle of the road.

}  // namespace pcl_bv::verges
