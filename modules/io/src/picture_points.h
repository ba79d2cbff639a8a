// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points of a picture, drawn straight into pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "picture_view.h"

namespace pcl_bv {

/// Red, green, blue in 0..1, as displayed (sRGB).
using Colour = std::array<float, 3>;

/// The colour of a cluster or volume: twelve that keep apart on a dark ground, again and again.
Colour palette(std::uint32_t number);

/// Rows of width x height pixels 0xffRRGGBB: the background and, nearest first, the points.
std::vector<std::uint32_t> draw_points(const Picture& picture, const View& view);

}  // namespace pcl_bv
