// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Rays against the objects and the ground of the street.
#pragma once

#include <cstdint>
#include <limits>

#include "street_layout.h"

namespace pcl_bv {

/// A ray of the sensor: from the origin in a unit direction, with a key for what is random about it.
struct Ray {
  Vec3 direction;
  std::uint64_t key;
};

/// Where a ray ends.
struct Hit {
  double range = std::numeric_limits<double>::infinity();  ///< Metres; infinite: nowhere.
  std::uint32_t object = 0;
  double loss = 0;  ///< Probability that the hit gives no return.
};

/// Replaces `hit` if the ray meets the object nearer.
void cast(const Ray& ray, const PlacedObject& object, Hit& hit);

/// Range at which the ray meets road, curb or sidewalk; infinity if never.
double cast_ground(const Ray& ray);

}  // namespace pcl_bv
