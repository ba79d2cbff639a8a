// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

enum class EstimationStatus : std::uint8_t {
  ok,               ///< The points span three dimensions.
  degenerate,       ///< The points lie in a plane, on a line or in one point: rank < 3.
  no_valid_points,  ///< Nothing to enclose: the volume is empty.
  failed            ///< A library below gave up: the volume is empty.
};

/// `rank` is how many dimensions the points span, whatever is fitted to them, however they are tilted and in
/// whatever order they come: 0 in one point, 1 on a line, 2 in a plane, all to within 2^-36 of the extent.
///
/// Exactly: p0 is the first valid point by (x, y, z), p1 the one farthest from p0, p2 from the line p0 p1, p3
/// from the plane p0 p1 p2, of equally far ones the first by (x, y, z). The rank is the number of these three
/// distances before the first that is at most 2^-36, in units of the widest side of the points' box rounded
/// down to a power of two (for sides of 2^-1000 or less: of 2^-1000). So points within 2^-41 of that of a
/// plane have rank 2 or less, and points of rank 2 are within 2^-36 of one.
struct EstimationResult {
  EstimationStatus status = EstimationStatus::no_valid_points;
  int rank = 0;
  std::size_t used = 0;       ///< Points enclosed.
  std::size_t dropped = 0;    ///< Points with a coordinate that is not finite (double: or beyond 1e100).
  std::string_view reason{};  ///< Why it failed, a text that is never freed; empty unless it did.
};

}  // namespace pcl_bv
