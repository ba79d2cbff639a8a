// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checks of a kernel's arguments before the kernel runs. Without these checks, a kernel could silently read
// or write past an array, or give a result from which the caller computes a volume that does not enclose the
// points. The checks take a few nanoseconds per call.
#pragma once

#include <cstddef>
#include <limits>

#include "pcl_bv/kernels/distances.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// Maximum number of points whose positions fit into 32 bits.
inline constexpr std::size_t kMaxPositions = std::size_t{1} << 32;

/// Throws std::invalid_argument unless the points are in memory and their number is at most `maximum`.
void require_in_memory(const PointView& points,
                       std::size_t maximum = std::numeric_limits<std::size_t>::max());

/// Throws std::invalid_argument unless the origin is valid and can be stored as a point of the view.
void require_origin(const PointView& points, const Coordinates& origin);

/// Throws like require_in_memory(). Also throws std::invalid_argument for float points if the scale is not 1,
/// because instruction sets would then give different results.
void require_distances(const PointView& points, const DistanceCenter& center,
                       std::size_t maximum = std::numeric_limits<std::size_t>::max());

/// Throws std::invalid_argument unless the points are floats and the bounds are not null. Only scans of float
/// points write bounds.
void require_scan_bounds(const PointView& block, const ScanBounds& scanned);

/// Throws std::invalid_argument, naming `what` and both numbers, if `count` exceeds `maximum`.
void require_at_most(std::size_t maximum, std::size_t count, const char* what);

}  // namespace pcl_bv::detail
