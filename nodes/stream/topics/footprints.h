// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "pcl_bv/messages/polygon.h"
#include "pcl_bv/nodes/frame_result.h"

namespace pcl_bv::detail {

/// The footprint of an object.
struct Footprint {
  std::int64_t id = 0;  ///< Of the track. Without a track: -1 - the number of the cluster.
  double distance = 0;  ///< Of the nearest corner from the origin.
  msg::PolygonStamped message;
};

/// Returns the footprints of a frame, the nearest one last: Nav2's subscriber keeps the last messages if
/// there are too many. A footprint is that of the first prism of the object or, without a prism, that of its
/// box (box_of()) along ground.up. Objects without a volume, or with a number that is not finite, are left
/// out.
std::vector<Footprint> footprints_of(const Frame& frame, const FrameResult& result);

}  // namespace pcl_bv::detail
