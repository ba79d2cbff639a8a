// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Counts the points near a point, with as many comparisons at a time as the processor has lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "distance.h"
#include "neighbourhood.h"

namespace pcl_bv::detail {

/// Coordinates of points in columns, for loops that compilers vectorise.
template <typename T>
class PointColumns {
 public:
  /// Number of points that are compared at a time. count_linked() reads up to kLanes - 1 numbers after the
  /// last point; assign() adds them.
  static constexpr std::size_t kLanes = 64 / sizeof(T);

  void assign(const std::vector<Point<T>>& points);

  /// Returns how many points of the runs have squared_distance() < r2 from p. May stop counting when at least
  /// `needed` are found.
  std::size_t count_linked(const PositionRange* runs, std::size_t run_count, const Point<T>& p, T r2,
                           std::size_t needed) const;

 private:
  std::vector<T> x_, y_, z_;
};

}  // namespace pcl_bv::detail
