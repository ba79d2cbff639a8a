// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The connected components of an EuclideanClusterer, point by point.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv::detail {

/// Throws std::invalid_argument if an option is outside its range.
void check(const ClusterOptions& options);

/// Returns a bound of the coordinate differences of a linked pair (d2 < r2). It may exceed the tolerance: r2
/// may be a denormal that was rounded up, or infinity while d2 is finite.
template <typename T>
double max_linked_difference(T r2) {
  using limits = std::numeric_limits<T>;
  return std::sqrt(static_cast<double>(std::clamp(r2, limits::denorm_min(), limits::max())));
}

/// The component of each point.
struct PointComponents {
  std::vector<std::uint32_t> component;  ///< Equal numbers for points of one component; below count + 1.
  std::vector<std::uint8_t> core;        ///< Whether each point is a core point; all are with min_points = 1.
  std::uint32_t noise = 0;               ///< The component of noise; of no point with min_points = 1.
};

struct ComponentAccess {
  /// Finds the components of points, which must be valid and have no index list. Ignores the options about
  /// sizes and ranges.
  static void find(EuclideanClusterer& clusterer, const PointView& view, const ClusterOptions& options,
                   const ParallelPolicy& policy, PointComponents& found);

 private:
  template <typename T>
  static void find(EuclideanClusterer& clusterer, const PointView& view, const ClusterOptions& options,
                   const ParallelPolicy& policy, PointComponents& found);
};

}  // namespace pcl_bv::detail
