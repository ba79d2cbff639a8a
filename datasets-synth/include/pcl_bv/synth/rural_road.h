// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Synthetic LiDAR sweeps of a rural road with ground truth for each point and object.
//
// The scene is harder to segment than the street (street.h). The road winds over hills with slopes of up to
// 16 %. The roadsides have kerbs, rough verges with grass, ditches, low walls and hedges. Tree crowns and
// bridges extend over the road. The objects include parked and moving cars, cyclists and groups of people.
// The car that carries the sensor drives at up to 12 m/s, brakes to a standstill, and turns at up to 31
// degrees per second.
//
// The fixed frame has x along the road's mean direction, y left, z up, metres. The road is infinite. The
// shape of an object depends only on the seed and the object's id.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/synth/street.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Options of make_rural_road_frame().
struct RuralRoadOptions {
  std::uint64_t seed = 1;
  /// Number of beams, which selects the sensor:
  ///
  /// - 16: elevations -15 to 15 degrees, 1.2 m above the road;
  /// - 32: elevations -30.67 to 10.67 degrees, 2.4 m above the road, pitched down by 5 degrees;
  /// - 64: elevations of the street's sensor (street_beam()), 1.73 m above the road;
  /// - 128: elevations -25 to 15 degrees, denser near the horizon, 2 m above the road, rolled by 2 degrees
  ///   (left side down).
  ///
  /// The sensor with 64 beams has 2000 azimuths, the others have 1800.
  std::size_t beams = 64;
};

/// Ground truth of one object within range of the sensor, occluded objects included. All returns of the
/// object lie inside its box, apart from the range noise.
struct RuralRoadObject {
  std::uint32_t id = 0;  ///< >= 1, the same in every frame.
  SynthObjectKind kind = SynthObjectKind::car;
  std::array<double, 3> center{};               ///< Centre of the box in the sensor's frame, metres.
  std::array<std::array<double, 3>, 3> axes{};  ///< Rows: forward, left, up, in the sensor's frame.
  std::array<double, 3> half_extents{};         ///< Half lengths of the box along the axes, metres.
  std::array<double, 3> velocity{};             ///< Velocity of the centre in the fixed frame, m/s.
  double yaw_rate = 0;                          ///< Yaw rate in the fixed frame, rad/s.
};

/// A sweep and its ground truth.
///
/// The rows, columns, rays without a return, and false returns of the cloud are as in StreetFrame. Returns
/// from grass have the label `vegetation` and are neither ground nor object.
struct RuralRoadFrame {
  SynthCloud cloud;
  std::vector<RuralRoadObject> objects;  ///< The objects nearer than street_max_range, by ascending id.
  std::array<double, 12> pose{};         ///< Pose of the sensor in the fixed frame: 3 x 4 matrix, row-major.
};

/// Returns the sweep at the time `frame * street_frame_seconds`. All rays are cast at this instant. Frames
/// are independent of one another. The same arguments give the same bits (on the same machine and libm).
/// Throws std::invalid_argument if the number of beams is not 16, 32, 64 or 128. O(points + frame), about 150
/// ms for 64 beams.
RuralRoadFrame make_rural_road_frame(const RuralRoadOptions& options, std::size_t frame);

/// Returns the objects and the pose of make_rural_road_frame(), with an empty cloud. O(frame), below 1 ms for
/// the first few thousand frames.
RuralRoadFrame make_rural_road_truth(const RuralRoadOptions& options, std::size_t frame);

/// Returns the height of the ground at (x, y) in the fixed frame, metres, without the roughness (up to 4 cm).
/// (x, y) must be within 100 m of the sensor's position in the sweep number `frame`.
double rural_road_ground_height(std::uint64_t seed, std::size_t frame, double x, double y);

}  // namespace pcl_bv
