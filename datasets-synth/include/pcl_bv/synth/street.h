// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A LiDAR sweep of a street whose every point and object is known, and sequences of such sweeps.
//
// The sensor is like an HDL-64E at the origin, x forward, y left, z up (against gravity), metres. It
// stands 1.73 m above a road that climbs by 5 % along +x, between curbs of 0.12 m with sidewalks, gardens and
// houses behind.
//
// Motion: the sensor drives along the road at 8 m/s, ten sweeps a second, each taken in an instant. Cars of
// its own lane keep its speed, oncoming cars drive at 11 m/s, pedestrians walk along the sidewalks at 1.1
// to 1.5 m/s; the rest stands. The street has no end: what an object is depends only on the seed and its id.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "pcl_bv/synth/synth_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

inline constexpr std::size_t street_beams = 64;
inline constexpr double street_sensor_height = 1.73;  ///< Metres above the road.
inline constexpr double street_slope = 0.05;          ///< Rise of the ground per metre along +x.
inline constexpr double street_curb_height = 0.12;    ///< Metres from the road up to the sidewalks.
inline constexpr double street_curb_left = 7.1;       ///< y of the left curb; the road is to its right.
inline constexpr double street_curb_right = -3.9;     ///< y of the right curb; the road is to its left.
inline constexpr double street_max_range = 100;       ///< Metres; what is farther gives no return.
inline constexpr double street_range_noise = 0.02;    ///< Standard deviation along the ray, metres.
inline constexpr double street_frame_seconds = 0.1;   ///< From one sweep to the next.

struct StreetOptions {
  /// Rays of a sweep, rounded by street_rays(); the default is 64 beams x 2000 azimuths.
  std::size_t points = 128'000;
  std::uint64_t seed = 1;
  std::size_t beams = street_beams;  ///< At least 1; twice as many lie half-way between those of 64 as well.
};

/// The last two are in the verges (verges.h) only.
enum class StreetObjectKind : std::uint8_t { car, pedestrian, pole, house, wall, hedge, tree, cyclist, bridge };

/// "car", "pedestrian", ...
std::string_view name_of(StreetObjectKind kind);

/// One object of the street within range of the sensor, whether or not a ray has reached it.
///
/// All its returns lie inside the box but for the range noise. Its base lies on the ground or, for upright
/// objects, at the lowest ground below it, so that the ground may hide some of it. Axes are forward, left,
/// up, in rows.
struct StreetObject {
  std::uint32_t id = 0;  ///< >= 1, the same in every frame.
  StreetObjectKind kind = StreetObjectKind::car;
  std::array<double, 3> center{};               ///< Of the box, in the sensor's frame.
  std::array<std::array<double, 3>, 3> axes{};  ///< Unit and orthogonal.
  std::array<double, 3> half_extents{};         ///< Metres, along the axes.
  std::array<double, 3> velocity{};             ///< Of the center in the sensor's frame, m/s; constant.
};

/// A sweep and the truth about it.
///
/// The cloud has a row for each beam, top one first, of one point per azimuth; column 0 looks backward and the
/// columns turn clockwise seen from above, so that the middle column looks forward. Rays without a return
/// (sky, out of range, 1.5 % at random, a third of those on car windows) are points at (0, 0, 0). One ground
/// return in 700 is a false one, below the ground, as mirrors and puddles give: object 0, ground 0. Curb
/// faces are ground.
struct StreetFrame {
  SynthCloud cloud;
  std::vector<StreetObject> objects;  ///< Those nearer than street_max_range, by ascending id.
};

/// The number of points of a sweep asked for with `points`: the nearest multiple of the beams, at least that
/// (half-way: up).
std::size_t street_rays(std::size_t points, std::size_t beams = street_beams);

/// The sweep at time frame * street_frame_seconds. Frames are independent of one another; same arguments,
/// same bits (same machine and libm). Throws nothing but std::bad_alloc. O(points), 25 ms for 128 000 rays.
StreetFrame make_street_frame(const StreetOptions& options, std::size_t frame);

/// Unit direction of a ray. Elevations as an HDL-64E: +2 to -8.33 degrees in steps of 1/3 for beams 0 to 31,
/// then -8.83 to -24.8 degrees in equal steps; other numbers lie between these.
std::array<double, 3> street_beam(double beam, std::size_t column, std::size_t columns);

/// Height z of the ground below or above (x, y), in the sensor's frame, the same in every frame.
double street_ground_height(double x, double y);

}  // namespace pcl_bv
