// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Results of the member functions mesh() and intersect() of the volumes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A closed polygon mesh in the frame and unit of the volume that it describes.
///
/// Faces are convex and counter-clockwise seen from outside. An empty volume has an empty mesh. A flat volume
/// has faces of area 0, or two faces that coincide.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<std::int32_t>> faces;  ///< Indices into `vertices`, in order around each face.
};

/// The part of the ray `origin + t * direction`, t >= 0, that is inside a volume: enter <= t <= exit. The
/// parameter t is in units of the direction's length, so the segment with t <= 1 meets the volume if enter <=
/// 1.
///
/// The member function intersect() of every volume returns this interval. intersect() returns nothing if the
/// ray misses the volume, if the volume is empty, or if the origin or direction is not finite.
///
/// The interval encloses the exact interval. Therefore, a ray that hits the volume is always reported as a
/// hit, even if it touches only one point or runs along a face. Each volume's intersect() documents the error
/// bound of `enter` and `exit`. For a zero direction, intersect() tests whether the origin is inside the
/// volume.
struct RayInterval {
  double enter;  ///< 0 if the origin is inside the volume.
  double exit;   ///< Infinity if the direction is zero.
};

}  // namespace pcl_bv
