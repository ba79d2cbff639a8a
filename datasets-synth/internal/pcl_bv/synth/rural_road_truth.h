// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground truth of sweeps of the rural road (rural_road.h) as lines of text.
#pragma once

#include <cstddef>
#include <string>

#include "pcl_bv/synth/rural_road.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Returns the pose in KITTI's format: 12 numbers, the upper three rows of the matrix from the sensor's frame
/// to the fixed frame, and a line feed. The numbers of pose_line() and truth_line() have enough digits to be
/// read back exactly.
std::string pose_line(const RuralRoadFrame& frame);

/// Returns one JSON object and a line feed. Its members are `seq` (the frame's number), `stamp_ns`, `pose`
/// (12 numbers as in pose_line()) and `objects`, by ascending id. Members of each element of `objects`:
///
///  id        id as in the cloud's field `object`, the same in every frame;
///  class     "car", ...;
///  center    centre of the box in the sensor's frame, metres;
///  axes      three rows (forward, left, up) in the sensor's frame;
///  yaw       angle of the forward axis about the sensor's z axis, radians;
///  size      full lengths of the box along its axes, metres;
///  velocity  velocity of the centre in the fixed frame, m/s;
///  yaw_rate  yaw rate in the fixed frame, rad/s;
///  points    number of returns of the object in the cloud (0: occluded).
std::string truth_line(const RuralRoadFrame& frame, std::size_t number);

}  // namespace detail
}  // namespace pcl_bv
