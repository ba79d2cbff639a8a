// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Positions of the objects on and beside the rural road, in the fixed frame.
#pragma once

#include <cstdint>
#include <vector>

#include "rural_road_world.h"
#include "street_layout.h"

namespace pcl_bv::rural_road {
using namespace detail;

struct PlacedRoadObject {
  PlacedObject object;  ///< Pose and velocity in the fixed frame.
  double yaw_rate = 0;  ///< rad/s
};

/// Returns the objects within about 130 m of the sensor's car along the road, by ascending id.
std::vector<PlacedRoadObject> place_road_objects(const World& world, std::uint64_t seed, double seconds);

/// Returns an object without a model, with position and axes. The forward axis points along the road, or
/// opposite if `backward` is true. The up axis is the ground's normal if `tilted` is true, otherwise
/// vertical.
PlacedObject on_road(const World& world, const RoadPosition& position, bool backward, bool tilted);

inline constexpr double own_lane = -1.75;  ///< Metres left of the middle of the road.

}  // namespace pcl_bv::rural_road
