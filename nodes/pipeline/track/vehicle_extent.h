// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Extends the box of a vehicle of which only a part is seen.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "pcl_bv/volumes/aabb.h"
#include "viewpoints.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// An object between two planes along each axis: its points p have low <= axes^T (p - origin) <= high. Axis 2
/// is up.
struct ObjectSlabs {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), low = Eigen::Vector3d::Zero(),
                  high = Eigen::Vector3d::Zero();

  double size(int axis) const { return high[axis] - low[axis]; }
  /// Makes the object `wanted` long along an axis, unless it is longer. The high face moves by the
  /// fraction `above` of the growth, the low face by the rest.
  void grow(int axis, double wanted, double above);
};

/// What may occlude parts of an object.
struct Surroundings {
  const Viewpoints* viewpoints = &Viewpoints::single();
  const std::vector<Aabb>* boxes = nullptr;  ///< All objects of the frame; null if they are not known.
  std::size_t own = 0;                       ///< Index of the object in `boxes`.
};

/// Returns the fraction of the growth along an axis by which the high face moves, so that the object grows
/// away from the sensors: 1 if they see the low face, 0 if they see the high face, otherwise 0.5.
double high_face_share(const ObjectSlabs& slabs, int axis, const Viewpoints& viewpoints);

/// Extends what was seen of a vehicle to the size of a small car, 3.9 m x 1.6 m. Objects that are too large
/// or too small for a side of a vehicle stay unchanged, and all objects if axis 2 is not z.
///
/// A vehicle with a velocity is long in its direction. Objects narrower than 1.2 m across it and shorter than
/// 2.5 m are two-wheelers, which stay unchanged. A velocity of zero is that of a vehicle that stands. If it
/// is longer than 2.1 m, its longer side is the length. If it is shorter, this side is the front or the rear,
/// or another object occludes an end of it. In the latter case the side continues behind that object. Objects
/// that stand must be at least 0.9 m high and 1.2 m wide. O(boxes).
void extend_vehicle(ObjectSlabs& seen, const Eigen::Vector3d& velocity, const Surroundings& around);

}  // namespace detail
}  // namespace pcl_bv
