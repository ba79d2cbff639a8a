// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <array>
#include <cstdint>

namespace pcl_bv {

/// Red, green, blue in 0..1, as displayed (sRGB).
using Colour = std::array<float, 3>;

/// The colour of a cluster or volume: twelve that keep apart on a dark ground, again and again.
Colour palette(std::uint32_t number);

}  // namespace pcl_bv
