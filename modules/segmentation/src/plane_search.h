// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the ground plane and writes the split.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/segmentation/ground.h"

namespace pcl_bv::detail {

/// All points p with normal.p = offset. The normal has unit length and points up.
struct Plane {
  Eigen::Vector3d normal;
  double offset;
};

/// Returns the signed distance of p from the plane.
inline double height_above(const Plane& plane, const Eigen::Vector3d& p) {
  return dot3(plane.normal, p) - plane.offset;
}

/// Number of points in the sample of a cloud. These are one in 15 points of a 64-beam sweep, and on average 8
/// points per cell of the grid seen from above.
inline constexpr std::size_t default_sample_size = 8192;

/// Finds the ground plane as split_ground() describes, in a sample of at most `sample_size` points.
/// options.sensor_height is the height of `sensor`.
std::optional<Plane> find_ground_plane(const PointView& points, const Eigen::Vector3d& sensor,
                                       const GroundPlaneOptions& options, GroundScratch& scratch,
                                       std::size_t sample_size = default_sample_size);

/// Stores `plane` in the split.
inline void set_plane(const std::optional<Plane>& plane, GroundSplit& split) {
  split.found = plane.has_value();
  split.normal = plane ? plane->normal : Eigen::Vector3d::Zero();
  split.offset = plane ? plane->offset : 0;
}

/// Numbers of points that write_lists() has written.
struct ListedPoints {
  std::size_t ground = 0, rest = 0;
};

/// Writes points to the two lists of the split, both from position `begin` on. visit(put) must call
/// put(index, is_ground) for each valid point. Each index is written to both lists, but only the end of one
/// list advances. This takes half the time of a branch, because branches are unpredictable in clouds in scan
/// order.
template <typename Visit>
ListedPoints write_lists(std::size_t begin, GroundSplit& split, const Visit& visit) {
  std::int32_t *const ground = split.ground.data() + begin, *const rest = split.rest.data() + begin;
  ListedPoints listed;
  visit([&](std::int32_t number, bool is_ground) {
    ground[listed.ground] = rest[listed.rest] = number;
    listed.ground += is_ground;
    listed.rest += !is_ground;
  });
  return listed;
}

/// Stores `plane` in the split and fills the two lists of the split. visit(put) is that of write_lists(); it
/// must call put() at most `max_count` times.
template <typename Visit>
void write_split(const std::optional<Plane>& plane, std::size_t max_count, GroundSplit& split,
                 const Visit& visit) {
  set_plane(plane, split);
  split.ground.resize(max_count);
  split.rest.resize(max_count);
  const ListedPoints listed = write_lists(0, split, visit);
  split.ground.resize(listed.ground);
  split.rest.resize(listed.rest);
}

}  // namespace pcl_bv::detail
