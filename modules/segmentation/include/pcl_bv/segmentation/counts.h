// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points that are in no cluster, by reason.
struct Counts {
  std::size_t nonfinite = 0;
  std::size_t range = 0;   ///< Finite, but too near or too far, or of the own vehicle.
  std::size_t ground = 0;  ///< Removed as ground.
  std::size_t small = 0;   ///< In clusters of too few points.
  std::size_t large = 0;   ///< In clusters of too many points.
  std::size_t noise = 0;   ///< Neither core of a cluster nor near to one: see ClusterSettings::min_points.
  std::size_t inside = 0;  ///< Dropped for regions: inside of one, or outside of all that are kept.
  std::size_t of_class = 0;  ///< Of a class that is dropped.
};

}  // namespace pcl_bv
