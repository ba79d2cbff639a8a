// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Estimates where the sensor of a cloud is. Ground zones, ranges and growing tolerances start at the sensor,
// which may be far from the origin if the cloud is in the frame of a map.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/ground_plane.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Checks whether a sensor at the position `assumed` may have recorded the cloud, and estimates the position
/// otherwise.
///
/// The check uses a sample of 1024 valid points, without those at (0, 0, 0), which are rays without a return.
/// Distances are horizontal, i.e. perpendicular to `up`, in metres. Most points of a LiDAR are near: in
/// recorded sweeps at least 72 % are within 12.5 m of the sensor, and at most 3 % are within 12.5 m of a
/// position 30 m away from it. So the points lie around `assumed` if 5 % of them are within 12.5 m of it.
/// They also do if 5 % are within 25 m, as for a sensor that is high up or looks far ahead, and no other
/// position has half of the points within 12.5 m. Fewer than 100 points lie around any position.
///
/// Returns `assumed` if the points lie around it. Otherwise returns the mean of the points within 12.5 m of
/// the densest position, at the height of `assumed`. The same points give the same bits. O(1) for points in
/// memory. Throws std::invalid_argument if `up` is 0 or not finite, or `assumed` is not finite.
SensorPosition find_sensor(const PointView& points, const Eigen::Vector3d& up, const Eigen::Vector3d& assumed,
                           GroundScratch& scratch);

/// An up direction and the share of the points that are ground in it.
struct OtherUp {
  Eigen::Vector3d up;  ///< Direction against gravity.
  double share;        ///< Share of the points near the ground plane, 0 to 1.
};
/// Searches another up direction, in which many more points of the cloud are ground.
///
/// The directions are z, -y (a camera's frame), y, -z, x, -x and (0, -1, -1) (a camera that looks down), in
/// this order, with the distance and slope of `settings`. A direction is accepted if it has a ground plane at
/// least 0.2 m below `sensor` with at most a tenth as many points below it as near it, and if the share of
/// points near it is at least 3 % and three times `found`, and at most 95 % (a cloud of one plane has no
/// clear up direction). If `found` is above 0, only the direction opposite to settings.up is tried, as a wall
/// may be larger than the ground. Directions close to settings.up are skipped.
///
/// Returns the first accepted direction; nothing if there is none. Takes at most seven plane searches among
/// 2048 points, some milliseconds each. Throws as split_ground().
std::optional<OtherUp> find_other_up(const PointView& points, const GroundPlaneSettings& settings,
                                     const Eigen::Vector3d& sensor, double found);

}  // namespace pcl_bv
