// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ray casting against the objects and the ground of the street.
#pragma once

#include <cstdint>
#include <limits>

#include "street_layout.h"

namespace pcl_bv::detail {

/// A ray of the sensor from the origin in a unit direction, with the seed of its random numbers.
struct Ray {
  Vec3 direction;
  std::uint64_t key;
};

/// The nearest surface that a ray hits.
struct Hit {
  double range = std::numeric_limits<double>::infinity();  ///< Metres; infinity: no hit.
  std::uint32_t object = 0;                                ///< Id of the object; 0: ground or no hit.
  double loss_probability = 0;                             ///< Probability that the hit gives no return.
};

/// Replaces `hit` if the ray hits the object at a smaller range.
void cast(const Ray& ray, const PlacedObject& object, Hit& hit);

/// Returns the range at which the ray hits road, curb or sidewalk; infinity if it hits none.
double cast_ground(const Ray& ray);

}  // namespace pcl_bv::detail
