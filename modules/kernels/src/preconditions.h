// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What every kernel asks of its caller before it runs: it would read or write past an array, or give a volume
// that does not enclose, without a word. A few nanoseconds a call.
#pragma once

#include <cstddef>
#include <limits>

#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv {

/// As many points as their positions can be told in 32 bits.
inline constexpr std::size_t kMostPositions = std::size_t{1} << 32;

/// Throws std::invalid_argument unless the points are in memory and at most `most`.
void require_in_memory(const PointView& points, std::size_t most = std::numeric_limits<std::size_t>::max());

/// Throws std::invalid_argument unless the origin is valid and can be stored as a point of the view.
void require_origin(const PointView& points, const Coordinates& origin);

/// As require_in_memory(); also for float points in a unit of their own, in which instruction sets differ.
void require_distances(const PointView& points, const DistanceCenter& center,
                       std::size_t most = std::numeric_limits<std::size_t>::max());

/// Throws std::invalid_argument unless there are bounds, which only scans of float points leave.
void require_bounds(const PointView& block, const KeptBounds& kept);

/// Throws std::invalid_argument, naming `what` and the range, if there are more than `most` of it.
void require_at_most(std::size_t most, std::size_t count, const char* what);

}  // namespace pcl_bv
