// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Synthetic LiDAR sweeps of a street with ground truth for each point and object.
//
// The sensor resembles an HDL-64E. The sensor's frame has its origin at the sensor, x forward, y left, z up
// (against gravity), metres. The sensor is 1.73 m above a road that climbs by 5 % along +x. The road lies
// between curbs that are 0.12 m high. Sidewalks, gardens and houses lie behind the curbs.
//
// The sensor drives along the road at 8 m/s and takes ten sweeps per second. All rays of a sweep are cast at
// the same instant. Cars in the sensor's lane drive at the sensor's speed, oncoming cars drive at 11 m/s.
// Pedestrians walk along the sidewalks at 1.1 to 1.5 m/s. All other objects are static. The street is
// infinite. The shape of an object depends only on the seed and the object's id.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "pcl_bv/synth/synth_cloud.h"

namespace [[gnu::visibility("default")]] pcl_bv {

inline constexpr std::size_t street_beams = 64;       ///< Number of beams of an HDL-64E.
inline constexpr double street_sensor_height = 1.73;  ///< Metres above the road.
inline constexpr double street_slope = 0.05;          ///< Rise of the ground per metre along +x.
inline constexpr double street_curb_height = 0.12;    ///< Metres from the road up to the sidewalks.
inline constexpr double street_curb_left = 7.1;       ///< y of the left curb; the road is to its right.
inline constexpr double street_curb_right = -3.9;     ///< y of the right curb; the road is to its left.
inline constexpr double street_max_range = 100;       ///< Metres; farther surfaces give no return.
inline constexpr double street_range_noise = 0.02;    ///< Standard deviation of the range, metres.
inline constexpr double street_frame_seconds = 0.1;   ///< Time between two sweeps, seconds.

/// Options of make_street_frame().
struct StreetOptions {
  /// Number of rays of a sweep, rounded by street_rays(). The default is 64 beams x 2000 azimuths.
  std::size_t points = 128'000;
  std::uint64_t seed = 1;
  /// Number of beams, at least 1. With 128 beams, an additional beam lies half a step below each of the 64
  /// default beams.
  std::size_t beams = street_beams;
};

/// Kinds of objects. Only the rural road (rural_road.h) has cyclists and bridges.
enum class SynthObjectKind : std::uint8_t {
  car,
  pedestrian,
  pole,
  house,
  wall,
  hedge,
  tree,
  cyclist,
  bridge
};

/// Returns the name of a kind: "car", "pedestrian", ...
std::string_view name_of(SynthObjectKind kind);

/// Ground truth of one object within range of the sensor, occluded objects included.
///
/// All returns of the object lie inside its box, apart from the range noise. The base of the box lies on the
/// ground. Upright objects (poles, pedestrians, trees, houses) have their base at the lowest ground height
/// below them, so the ground may occlude a part of them.
struct StreetObject {
  std::uint32_t id = 0;  ///< >= 1, the same in every frame.
  SynthObjectKind kind = SynthObjectKind::car;
  std::array<double, 3> center{};               ///< Centre of the box in the sensor's frame, metres.
  std::array<std::array<double, 3>, 3> axes{};  ///< Orthonormal rows: forward, left, up.
  std::array<double, 3> half_extents{};         ///< Half lengths of the box along the axes, metres.
  std::array<double, 3> velocity{};             ///< Constant velocity of the centre, sensor's frame, m/s.
};

/// A sweep and its ground truth.
///
/// The cloud has one row per beam, the top beam first, and one column per azimuth. Column 0 points backward
/// and the azimuths run clockwise as seen from above, so the middle column points forward. Curb faces are
/// labelled as ground.
///
/// A ray without a return gives a point at (0, 0, 0). Rays into the sky and rays that hit nothing within
/// street_max_range have no return. One third of the rays that hit a car's cabin (glass) and 1.5 % of all
/// other rays have no return, at random.
///
/// One ground return in 700 is replaced by a false return below the ground. Mirrors and puddles cause such
/// returns. The labels `object` and `ground` of a false return are 0.
struct StreetFrame {
  SynthCloud cloud;
  std::vector<StreetObject> objects;  ///< The objects nearer than street_max_range, by ascending id.
};

/// Returns the number of points of a sweep with the options `points` and `beams`. The result is the multiple
/// of `beams` nearest to `points`, but at least `beams`. Half-way cases round up.
std::size_t street_rays(std::size_t points, std::size_t beams = street_beams);

/// Returns the sweep at the time `frame * street_frame_seconds`. Frames are independent of one another. The
/// same arguments give the same bits (on the same machine and libm). Throws only std::bad_alloc. O(points),
/// 25 ms for 128 000 rays.
StreetFrame make_street_frame(const StreetOptions& options, std::size_t frame);

/// Returns the unit direction of a ray in the sensor's frame. The elevations are those of an HDL-64E: +2 to
/// -8.33 degrees in steps of 1/3 degree for beams 0 to 31, then -8.83 to -24.8 degrees in equal steps for
/// beams 32 to 63. Fractional beam numbers are interpolated.
std::array<double, 3> street_beam(double beam, std::size_t column, std::size_t columns);

/// Returns the height z of the ground at (x, y) in the sensor's frame, metres. The height is the same in
/// every frame.
double street_ground_height(double x, double y);

}  // namespace pcl_bv
