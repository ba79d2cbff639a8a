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

/// The ground of the points sampled by sample_ground(), in their frame, as split_ground() says. `sensor` is
/// the origin of the cloud in that frame.
std::optional<Plane> find_ground_plane(const GroundScratch& points, const Eigen::Vector3d& sensor,
                                       const GroundPlaneSettings& settings);

}  // namespace pcl_bv
