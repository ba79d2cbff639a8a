// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Ground removal by one plane, without PCL: what has to go before clustering, since the ground touches
// everything that stands on it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What counts as ground.
struct GroundPlaneSettings {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Against gravity; any length above 0.
  double distance = 0.2;          ///< Points at most this far above the plane are ground, metres; > 0.
  double max_slope_degrees = 15;  ///< Greatest angle between the plane's normal and up, 0 to 89.
  /// Height of the cloud's origin above the ground, along up, metres; >= 0. If given, planes that pass below
  /// the origin at a height that differs by more than ground_height_tolerance are out of the question.
  std::optional<double> sensor_height;
  std::uint32_t seed = 1;      ///< Of the search. Another seed may move the plane by millimetres.
  unsigned iterations = 1000;  ///< Planes tried, 1 to 1000000.
};

/// Metres. A vehicle pitches, and its ground is no plane; car bonnets and tables are 0.7 m up and more.
inline constexpr double ground_height_tolerance = 0.5;

/// Memory that calls of split_ground share.
struct GroundScratch {
  std::vector<Eigen::Vector3d> sample, support, lowest;
};

/// Where a cloud's sensor is (find_sensor() of sensor_place.h).
struct SensorPlace {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< In the frame of the cloud, metres.
  bool around = true;  ///< Whether the points lie around the place that was said; if not, `at` is estimated.
  double far_share = 0;  ///< Share of the points that are 100 m or more from `at`, 0 to 1.
};

/// A cloud split into ground and rest. Reuse keeps the capacity.
struct GroundSplit {
  bool found = false;  ///< Whether there is a plane; if not, all valid points are `rest`.
  /// Unit normal on the upper side; the height of p above the plane is normal.p - offset. 0 if not found.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset = 0;     ///< Metres, in the frame of the cloud.
  SensorPlace sensor{};  ///< Of zones: where they are centred; a place that is given is not checked.
  bool level = false;    ///< Of zones: no plane was found, and level ground at sensor_height was assumed.
  std::vector<std::int32_t> ground;  ///< Numbers in the cloud (PointView::index) of the ground's points, in
                                     ///< the order of the view.
  std::vector<std::int32_t> rest;    ///< Those of the other valid points.
  GroundScratch scratch;             ///< Of no meaning to the caller.
};

/// Finds the ground as one plane and splits the points by it.
///
/// Ground is every point with (nx*x + ny*y) + nz*z - offset <= distance in double. So it includes what lies
/// below the plane, however deep: reflections from puddles and windows must not become objects, nor must a
/// ground that falls away. Beware that things standing down there are lost with it; a hilly scene wants a
/// ground of many planes.
///
/// Among the planes within the limits the one with most points near it wins, but a point clearly below it
/// weighs as much as four above it: the floor is preferred to the tables and the road to the roofs, as long
/// as it has a quarter of their points. For this choice points count by area seen from above, so that dense
/// rings near the sensor do not outvote the road far off; then least squares over the points near the plane,
/// by number, say where exactly it is. Nothing else is asked of a ground: three points are one, if their
/// plane is within the limits.
///
/// Points that are not valid (is_valid()) are in neither list. Not found: fewer than three valid points, all
/// points on a line, no plane within the limits, or only such as have a third as many points below them as
/// near them.
///
/// Same points, settings and seed give the same bits. Throws std::invalid_argument for a setting outside its
/// range, std::length_error if a point number exceeds 2^31 - 1. O(n) beyond a search of constant cost; keeps
/// 8 bytes a point for the next call.
///
/// Source: RANSAC (Fischler and Bolles 1981) with the truncated cost MSAC (Torr and Zisserman 2000), then
/// least squares.
void split_ground(const PointView& points, const GroundPlaneSettings& settings, GroundSplit& split);

}  // namespace pcl_bv
