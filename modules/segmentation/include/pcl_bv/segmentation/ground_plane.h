// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal by one plane, without PCL. Clustering needs it because the ground would connect all objects.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Options of split_ground().
struct GroundPlaneOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity; any length above 0.
  /// Points at most this far above the plane are ground; metres, > 0.
  double distance = 0.2;
  double max_slope_degrees = 15;  ///< Largest angle between the plane's normal and up, 0 to 89.
  /// Height of the cloud's origin above the ground, along up; metres, >= 0. If given, the plane must be this
  /// far below the origin, to within ground_height_tolerance.
  std::optional<double> sensor_height;
  std::uint32_t seed = 1;      ///< Seed of the random search. Other seeds may move the plane by millimetres.
  unsigned iterations = 1000;  ///< Number of planes tried, 1 to 1000000.
};

/// Largest accepted error of a given sensor height, metres. It allows for pitching vehicles and uneven
/// ground. It excludes car bonnets and tables, which are 0.7 m high and more.
inline constexpr double ground_height_tolerance = 0.5;

/// Buffers that calls of split_ground() reuse.
struct GroundScratch {
  std::vector<Eigen::Vector3d> sample, support, lowest;
};

/// Position of the sensor of a cloud, found by find_sensor() in sensor_position.h.
struct SensorPosition {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< In the frame of the cloud, metres.
  /// Whether the points lie around the assumed position. If they do not, `position` is an estimate.
  bool confirmed = true;
  double far_share = 0;  ///< Share of points that are 100 m or farther from `position`, 0 to 1.
};

/// A cloud split into ground and other points. Reusing an object reuses its memory.
struct GroundSplit {
  bool found = false;  ///< Whether there is a plane. If not, all valid points are in `rest`.
  /// Unit normal of the plane, pointing up; 0 if no plane was found. The height of a point p above the plane
  /// is normal.p - offset.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset = 0;  ///< Metres, in the frame of the cloud.
  /// Centre of the rings of GroundZones. A position given in the options is not checked. split_ground() does
  /// not set it.
  SensorPosition sensor{};
  /// Whether GroundZones found no plane and assumed level ground at sensor_height. Not set by split_ground().
  bool assumed_level = false;
  /// Indices of the ground points in the cloud (PointView::index()), in the order of the view.
  std::vector<std::int32_t> ground;
  std::vector<std::int32_t> rest;  ///< Indices of the other valid points.
  GroundScratch scratch;           ///< Internal buffers.
};

/// Finds the ground as one plane and splits the points by it.
///
/// Ground is every point with (nx*x + ny*y) + nz*z - offset <= distance in double. So all points below the
/// plane are ground, however deep, such as reflections from puddles and windows or ground that slopes down.
/// Objects below the plane are lost. For hilly scenes use GroundZones.
///
/// The plane is the one within the limits that has most points near it. A point clearly below a plane costs
/// as much as four points clearly above it. So a floor is preferred to a table, and a road to a roof, if the
/// lower surface has a quarter of the points of the upper one. The search weights points by the area that
/// they cover seen from above, so that dense rings near the sensor do not outvote the distant road. Least
/// squares over the sampled points near the plane then refine it. Three points are enough if their plane is
/// within the limits.
///
/// Points that are not valid (is_valid()) are in neither list. No plane is found in these cases:
/// - There are fewer than three valid points, or all points are on a line.
/// - No plane is within the limits.
/// - Each plane has at least a third as many points below it as near it.
///
/// The same points and options give the same bits. The cost is O(n) in addition to a search of
/// constant cost. `split` retains 8 bytes per point for the next call. Throws std::invalid_argument for an
/// option outside its range and std::length_error if a point index exceeds 2^31 - 1.
///
/// Source: RANSAC (Fischler, Bolles 1981) with the truncated cost MSAC (Torr, Zisserman 2000), then least
/// squares.
void split_ground(const PointView& points, const GroundPlaneOptions& options, GroundSplit& split);

/// Returns the split as a new object.
GroundSplit split_ground(const PointView& points, const GroundPlaneOptions& options = {});

}  // namespace pcl_bv
