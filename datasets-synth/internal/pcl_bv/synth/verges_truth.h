// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The truth about sweeps of the road with verges (verges.h) as lines of text, for files beside them.
#pragma once

#include <cstddef>
#include <string>

#include "pcl_bv/synth/verges.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The pose as KITTI writes it: 12 numbers, the upper rows of the matrix from the sensor's to the fixed
/// frame, and the line's end. Numbers here and in truth_line() read back as the same doubles.
std::string pose_line(const VergesFrame& frame);

/// One JSON object and the line's end: `seq` (the frame's number), `stamp_ns`, `pose` (12 numbers) and
/// `objects`, by ascending id, each with
///
///  id        as in the cloud's field `object`, the same in every frame;
///  class     "car", ...;
///  center    of the box, in the sensor's frame, metres;
///  axes      forward, left, up: three rows, in the sensor's frame;
///  yaw       of the forward axis about the sensor's z, radians;
///  size      of the box along its axes, metres;
///  velocity  of the center in the fixed frame, m/s;
///  yaw_rate  in the fixed frame, rad/s;
///  points    how many returns of it the cloud has (0: hidden).
std::string truth_line(const VergesFrame& frame, std::size_t number);

}  // namespace pcl_bv
