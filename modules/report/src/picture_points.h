// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <vector>

#include "palette.h"
#include "picture_view.h"

namespace pcl_bv {

/// Rows of width x height pixels 0xffRRGGBB: the background and, nearest first, the points.
std::vector<std::uint32_t> draw_points(const Picture& picture, const View& view);

}  // namespace pcl_bv
