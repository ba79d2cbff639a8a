// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Which point belongs to which object.
#pragma once

#include <cstdint>
#include <vector>

#include "pcl_bv/nodes/frame_result.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// For each point of the frame's cloud (where `points` has an index list: up to the greatest number in it)
/// the number of its cluster, else 4294967294 for ground, 4294967295 for none. `result` must be that of the
/// frame.
std::vector<std::uint32_t> labels_of(const Frame& frame, const FrameResult& result);

}  // namespace pcl_bv
