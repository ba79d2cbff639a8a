// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One cloud of a stream on its way in.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "pcl_bv/kernels/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What names a frame; kept as it came.
struct FrameHeader {
  std::uint64_t seq = 0;      ///< Number in the stream.
  std::int64_t stamp_ns = 0;  ///< When the sensor took it, nanoseconds of the sensor's clock.
  std::string frame_id;       ///< The coordinate frame of the points.
};

/// A cloud of any point type. `owner` keeps alive what `points` looks at.
struct Frame {
  FrameHeader header;
  PointView points;
  std::shared_ptr<const void> owner;
  double decode_ms = 0;  ///< What reading it cost, if somebody measured it.
};

}  // namespace pcl_bv
