// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What our kernels are held against, on the same instruction sets: memory that is only read, and the paper's
// Figure 2 with neither a test of the points nor exact arithmetic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pcl_bv/numeric/directions.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::bench {
using namespace detail;

/// The exclusive or of all 64-bit words of an array, each vector loaded once: nothing that looks at all bytes
/// can be faster than the best number of `streams` (1, 2, 4 or 8 places that are read in turn).
std::uint64_t read_words(Isa isa, const std::uint64_t* words, std::size_t count, unsigned streams);

/// Least and greatest rounded projections along the first 3 or all 13 of kCubeDirections.
struct UncheckedExtents {
  std::array<float, kMaxDirections> low;
  std::array<float, kMaxDirections> high;
};

/// Of a view of pcl::PointXYZ, a multiple of 16 points; what a NaN does to it is not said. `isa` is not
/// `scalar`.
UncheckedExtents unchecked_aabb(Isa isa, const PointView& points);
UncheckedExtents unchecked_dop26(Isa isa, const PointView& points);

/// The second with the test of every point that the library makes, and still no exact arithmetic: what the
/// test costs by itself. Not numbers, if a point is not finite.
UncheckedExtents tested_dop26(Isa isa, const PointView& points);

}  // namespace pcl_bv::bench
