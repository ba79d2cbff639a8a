// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers of points that are in no cluster.
#pragma once

#include <cstddef>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Numbers of points that are in no cluster, by reason.
struct Counts {
  std::size_t nonfinite = 0;      ///< Points with a coordinate that is not finite.
  std::size_t range = 0;          ///< Finite points outside the range limits or on the own vehicle.
  std::size_t ground = 0;         ///< Points removed as ground.
  std::size_t small = 0;          ///< Points in clusters of too few points.
  std::size_t large = 0;          ///< Points in clusters of too many points.
  std::size_t noise = 0;          ///< Noise points; see ClusterOptions::min_points.
  std::size_t inside = 0;         ///< Points inside a region to drop, or outside all regions to keep.
  std::size_t dropped_class = 0;  ///< Points of a class that is dropped.
};

}  // namespace pcl_bv
