// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Estimates where the sensor of a cloud is. Ground zones, the ranges of points and growing tolerances are
// measured from the sensor. If the cloud is in the frame of a map, the sensor may be far from the origin.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/ground_plane.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Checks whether a sensor at the position `assumed` may have recorded the cloud. If not, estimates the
/// position of the sensor.
///
/// The check uses a sample of at most 1024 valid points, without the points at (0, 0, 0), which are rays
/// without a return. Distances are horizontal, i.e. perpendicular to `up`, in metres. Most points of a LiDAR
/// are near the sensor: in recorded sweeps at least 72 % of the points are within 12.5 m of the sensor, and
/// at most 3 % are within 12.5 m of a position 30 m away from the sensor. So the points lie around `assumed`
/// if one of these holds:
/// - At least 5 % of the points are within 12.5 m of `assumed`.
/// - At least 5 % are within 25 m of `assumed`, as for a sensor that is high up or looks far ahead, and no
///   other position has half of the points within 12.5 m.
/// - The sample has fewer than 100 points.
///
/// Returns `assumed` if the points lie around it. Otherwise returns the mean of the points within 12.5 m of
/// the densest position, at the height of `assumed`. The same points give the same bits. O(1) for points in
/// memory. Throws std::invalid_argument if `up` is 0 or not finite, or if a coordinate of `assumed` is not
/// from -1e100 to 1e100.
SensorPosition find_sensor(const PointView& points, const Eigen::Vector3d& up, const Eigen::Vector3d& assumed,
                           GroundScratch& scratch);

/// An up direction and the share of the points that are ground in it.
struct OtherUp {
  Eigen::Vector3d up;  ///< Direction against gravity.
  double share;        ///< Share of the points near the ground plane, 0 to 1.
};
/// Searches another up direction, in which many more points of the cloud are ground.
///
/// The directions are z, -y (a camera's frame), y, -z, x, -x and (0, -1, -1) (a camera that looks down). They
/// are tried in this order, with the distance and slope of `options`. Directions close to options.up are
/// skipped. `found` is the share of ground points for options.up. If it is above 0, only the direction
/// opposite to options.up is tried, because a wall may be larger than the ground. A direction is accepted if
/// all of these hold:
/// - It has a ground plane at least 0.2 m below `sensor`.
/// - At most a tenth as many points are below the plane as near it.
/// - The share of points near the plane is at least 3 % and at least three times `found`.
/// - This share is at most 95 %, because a cloud of one plane has no clear up direction.
///
/// Returns the first accepted direction. If there is none, returns nothing. Takes at most seven plane
/// searches among 2048 points, some milliseconds each. Throws std::invalid_argument if options.up is 0 or
/// not finite. The other options are not checked.
std::optional<OtherUp> find_other_up(const PointView& points, const GroundPlaneOptions& options,
                                     const Eigen::Vector3d& sensor, double found);

}  // namespace pcl_bv
