// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Positions of the street's objects in one frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "street_model.h"

namespace pcl_bv::detail {

/// A model placed in the sensor's frame. The origin of the model is at `base`, and the axes of the model are
/// `forward`, `left` and `up`.
struct PlacedObject {
  std::uint32_t id = 0;
  Model model;
  Vec3 base;
  Vec3 forward, left, up;
  Vec3 velocity;  ///< In the sensor's frame, m/s.

  /// Rotates a direction from the sensor's frame to the model's frame. Does not subtract `base`.
  Vec3 to_local(Vec3 direction) const {
    return {dot(direction, forward), dot(direction, left), dot(direction, up)};
  }
  Vec3 to_sensor(Vec3 local) const { return base + local.x * forward + local.y * left + local.z * up; }
};

/// Returns the objects nearer than street_max_range, by ascending id.
std::vector<PlacedObject> place_objects(std::uint64_t seed, std::size_t frame);

/// Returns the distance from the sensor to an object's box in the object's x-y plane. The distance is a lower
/// bound on the range of the object's returns.
double min_range(const PlacedObject& object);

}  // namespace pcl_bv::detail
