// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Where a cloud's sensor is: ground by zones, ranges and tolerances that grow with them start there, and a
// cloud in a map's frame has it far from the origin.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/ground_plane.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Checks whether a sensor at `said` may have taken the cloud, by a sample of 1024 valid points other than
/// (0, 0, 0), which are rays without a return. Distances are horizontal, across `up`, in metres.
///
/// A LiDAR has most of its points near: of recorded sweeps 72 % or more lie within 12.5 m of the sensor, and
/// within 12.5 m of a place 30 m beside it at most 3 %. So the points are around `said` if 5 % of them are
/// within 12.5 m of it. They are, too, if 5 % are within 25 m, as of a sensor high up or one that looks far
/// ahead, and no other place has half of the points within 12.5 m. Fewer than 100 points are around any
/// place.
///
/// Returns `said` as `at` if they are around it, otherwise the mean of the points within 12.5 m of where they
/// are densest, at the height of `said`. Same points, same bits. Throws std::invalid_argument if `up` is no
/// direction or `said` not finite. O(1) for points in memory.
SensorPlace find_sensor(const PointView& points, const Eigen::Vector3d& up, const Eigen::Vector3d& said,
                        GroundScratch& scratch);

/// Searches another up direction in which far more of the cloud is ground: z, -y (a camera's frame), y, -z,
/// x, -x and (0, -1, -1) (a camera that looks down) in turn, with settings' distance and slope. In such a
/// direction there is a plane, at least 0.2 m below `sensor`, and at most a tenth as many points below it as
/// near it; it is the first of them with three times the share `found`, 3 % at least and 95 % at most
/// (a cloud of one plane says nothing about up). Where `found` is
/// above 0, only the direction opposite to settings.up is searched: a wall may be larger than the ground.
///
/// Returns the direction and its share of the points that are near the plane; nothing if there is none.
/// Throws as split_ground(). At most seven searches for a plane among 2048 points, some
/// milliseconds each.
struct OtherUp {
  Eigen::Vector3d up;
  double share;  ///< 0 to 1.
};
std::optional<OtherUp> find_other_up(const PointView& points, const GroundPlaneSettings& settings,
                                     const Eigen::Vector3d& sensor, double found);

}  // namespace pcl_bv
