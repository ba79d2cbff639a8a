// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The pass over a cloud on a device that leaves a few points and blocks in which all support points are.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "device_points.h"
#include "pcl_bv/numeric/directions.h"

namespace pcl_bv::detail {

struct DeviceExtremes {
  std::size_t dropped = 0;  ///< Number of points that are not valid.
  std::array<float, 3>
      low{};  ///< Smallest coordinates, as the device has the points. 0 without a valid point.
  std::array<float, 3> high{};
  /// Whether `candidates` has every block with a support point. Otherwise there are too many such blocks, or
  /// float projections of the points could overflow.
  bool complete = false;
  std::vector<std::uint32_t> candidates;  ///< Numbers of blocks of kBlockPoints points, ascending.
  /// Positions of all points that can be support points, ascending. Empty if the processor cannot read single
  /// points (DevicePoints::has_points_in_memory()), or if these are more than max_near_points.
  std::vector<std::int32_t> near_points;
};

/// Largest number of points that are listed one by one. Measured clouds have 25 to 100.
inline constexpr std::uint32_t max_near_points = 4096;

/// Largest number of candidates of a cloud; the processor is as fast for more.
constexpr std::size_t max_candidates(std::size_t blocks) {
  return 256 + blocks / 16;
}

/// Finds the extremes of a cloud of at least one point. Lists candidates if `list`. Throws GpuError.
DeviceExtremes find_extremes(const DevicePoints& cloud, DirectionSet set, bool list);

}  // namespace pcl_bv::detail
