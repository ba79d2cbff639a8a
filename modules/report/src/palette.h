// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The colours of clusters and volumes in pictures and meshes.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>

namespace pcl_bv::detail {

/// Red, green and blue in 0..1, as displayed (sRGB).
using Colour = std::array<float, 3>;

/// Colours of similar brightness that are easy to distinguish on a dark background. Successive colours differ
/// strongly in hue.
inline constexpr Colour palette_colours[] = {
    {0.37f, 0.78f, 0.97f}, {1.00f, 0.62f, 0.35f}, {0.49f, 0.91f, 0.53f}, {1.00f, 0.48f, 0.61f},
    {0.78f, 0.61f, 1.00f}, {1.00f, 0.85f, 0.40f}, {0.31f, 0.88f, 0.82f}, {1.00f, 0.44f, 0.38f},
    {0.56f, 0.70f, 1.00f}, {0.78f, 0.96f, 0.39f}, {0.97f, 0.66f, 0.88f}, {0.40f, 0.85f, 0.65f}};

/// Returns the colour of a cluster or volume. The twelve colours repeat.
inline Colour palette(std::uint32_t number) {
  return palette_colours[number % std::size(palette_colours)];
}

}  // namespace pcl_bv::detail
