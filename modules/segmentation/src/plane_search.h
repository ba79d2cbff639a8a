// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <optional>

#include "pcl_bv/numeric/vector3.h"
#include "pcl_bv/segmentation/ground_plane.h"

namespace pcl_bv {

/// The points p with normal.p = offset; the normal is of unit length and on the upper side.
struct Plane {
  Eigen::Vector3d normal;
  double offset;
};

/// Signed distance of p from the plane.
inline double height_above(const Plane& plane, const Eigen::Vector3d& p) {
  return dot3(plane.normal, p) - plane.offset;
}

/// Points that stand for a whole cloud: of a 64-beam sweep one in 15, still 8 for each cell of area.
inline constexpr std::size_t cloud_sample = 8192;

/// The ground's plane as split_ground() says; `sensor` is what settings.sensor_height is the height of. At
/// most `sample_size` points are looked at.
std::optional<Plane> find_ground_plane(const PointView& points, const Eigen::Vector3d& sensor,
                                       const GroundPlaneSettings& settings, GroundScratch& scratch,
                                       std::size_t sample_size = cloud_sample);

/// Makes `plane` that of the split and fills its lists: visit(put) calls put(number, is_ground) for each
/// valid point, at most `most` times. Every number is written to both lists, and kept in one by moving its
/// end: half the time of a branch that a cloud in scan order makes unpredictable.
template <typename Visit>
void write_split(const std::optional<Plane>& plane, std::size_t most, GroundSplit& split,
                 const Visit& visit) {
  split.found = plane.has_value();
  split.normal = plane ? plane->normal : Eigen::Vector3d::Zero();
  split.offset = plane ? plane->offset : 0;
  split.ground.resize(most);
  split.rest.resize(most);
  std::size_t ground = 0, rest = 0;
  visit([&](std::int32_t number, bool is_ground) {
    split.ground[ground] = split.rest[rest] = number;
    ground += is_ground;
    rest += !is_ground;
  });
  split.ground.resize(ground);
  split.rest.resize(rest);
}

}  // namespace pcl_bv
