// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A country road whose every point and object is known, harder than the street (street.h): it winds over
// hills of up to 15 %, with kerbs, rough verges with grass, ditches, low walls, hedges, trees whose crowns hang
// over the road, bridges over it, parked and moving cars, cyclists and people in groups. The sensor's own car
// drives it at up to 12 m/s, brakes to a stand, and turns at up to 30 degrees a second.
//
// The fixed frame is x along the road's mean direction, y left, z up, metres. The road has no end: what an
// object is depends only on the seed and its id.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcl_bv/synth/street.h"

namespace [[gnu::visibility("default")]] pcl_bv {

struct VergesOptions {
  std::uint64_t seed = 1;
  /// 16: elevations of -15 to 15 degrees, 1.2 m above the road. 32: -30.67 to 10.67 degrees, 2.4 m above it, pitched
  /// down by 5 degrees. 64: those of the street, 1.73 m. 128: -25 to 15 degrees, denser about the horizon, 2 m,
  /// rolled by 2 degrees. 1800 azimuths (64: 2000).
  std::size_t beams = 64;
};

/// One object within range of the sensor, whether or not a ray has reached it. All its returns lie inside the box but
/// for the range noise.
struct VergesObject {
  std::uint32_t id = 0;  ///< >= 1, the same in every frame.
  StreetObjectKind kind = StreetObjectKind::car;
  std::array<double, 3> center{};               ///< Of the box, in the sensor's frame, metres.
  std::array<std::array<double, 3>, 3> axes{};  ///< Forward, left, up in rows, in the sensor's frame.
  std::array<double, 3> half_extents{};         ///< Metres, along the axes.
  std::array<double, 3> velocity{};             ///< Of the center, in the fixed frame, m/s.
  double yaw_rate = 0;                          ///< In the fixed frame, rad/s.
};

/// A sweep and the truth about it.
///
/// Rows and columns of the cloud as of StreetFrame, and so rays without a return and false ones. Grass is neither
/// ground nor object, but `vegetation`.
struct VergesFrame {
  SynthCloud cloud;
  std::vector<VergesObject> objects;  ///< Those nearer than street_max_range, by ascending id.
  std::array<double, 12> pose{};      ///< Of the sensor in the fixed frame, 3 x 4, row by row.
};

/// The sweep at time frame * street_frame_seconds, taken in an instant. Frames are independent of one another; same
/// arguments, same bits (same machine and libm). Throws std::invalid_argument for other numbers of beams.
/// O(points + frame), some 150 ms for 64 beams.
VergesFrame make_verges_frame(const VergesOptions& options, std::size_t frame);

/// The same frame without its cloud: objects and pose. O(frame), below a millisecond for the first thousands.
VergesFrame make_verges_truth(const VergesOptions& options, std::size_t frame);

/// Height of the ground in the fixed frame, metres, but for its roughness of up to 5 cm.
double verges_ground_height(std::uint64_t seed, std::size_t frame, double x, double y);

}  // namespace pcl_bv
