// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Positions of the objects on and beside the rural road, in the fixed frame.
#pragma once

#include <cstdint>
#include <vector>

#include "rural_road_world.h"
#include "street_layout.h"

namespace pcl_bv::rural_road {

struct PlacedRoadObject {
  PlacedObject object;  ///< Pose and velocity in the fixed frame.
  double yaw_rate = 0;  ///< rad/s
};

/// Returns the objects up to about 130 m along the road from the sensor's car, by ascending id.
std::vector<PlacedRoadObject> place_road_objects(const World& world, std::uint64_t seed, double seconds);

/// Returns position and axes of an object on the road, without a model. The forward axis is along the road,
/// or opposite if `backward`. The up axis is the ground's normal if `tilted`, otherwise vertical.
PlacedObject on_road(const World& world, const RoadPosition& position, bool backward, bool tilted);

inline constexpr double own_lane = -1.75;  ///< Metres left of the middle of the road.

}  // namespace pcl_bv::rural_road
