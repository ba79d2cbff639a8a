// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A cloud and its volumes as a page to look at, in one file that needs nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv {

/// Points in a page: 20 bytes of text each. Of more, every other, third, ... one is left out.
inline constexpr std::size_t kMostPointsOfAPage = 500'000;

/// The page as HTML. `labels` as labels_of() has them; empty: all points are of cluster 0. Coordinates become
/// float32 relative to whole numbers near their middle.
std::string view_html(const Frame& frame, const FrameResult& result, const Report& report,
                      const std::vector<std::uint32_t>& labels, std::size_t most_points = kMostPointsOfAPage);

}  // namespace pcl_bv
