// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes a cloud and its volumes as a self-contained HTML page.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcl_bv/nodes/frame_result.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv::detail {

/// Maximum number of points in a page. Each point takes 22 bytes of text, or 27 with intensity. Larger clouds
/// are subsampled evenly.
inline constexpr std::size_t kMaxPagePoints = 500'000;

/// Returns the page as HTML. `labels` is the result of labels_of(). If it is empty, all points belong to
/// cluster 0. Coordinates are stored as float32 relative to an origin. The origin is the centre of the
/// axis-aligned box of all volumes, rounded to whole numbers.
std::string view_html(const Frame& frame, const FrameResult& result, const Report& report,
                      const std::vector<std::uint32_t>& labels, std::size_t max_points = kMaxPagePoints);

}  // namespace pcl_bv::detail
