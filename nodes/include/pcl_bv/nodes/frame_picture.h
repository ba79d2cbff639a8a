// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "pcl_bv/nodes/frame.h"
#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/report/picture.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The frame and what was found in it, up as the configuration says: with clusters the points that passed
/// the filter in the colours of `labels`, as labels_of() gives them, and each cluster's id; else those that
/// are no ground. Views the frame, the result and the labels.
Picture picture_of(const Frame& frame, const FrameResult& result, const std::vector<std::uint32_t>& labels);

}  // namespace pcl_bv
