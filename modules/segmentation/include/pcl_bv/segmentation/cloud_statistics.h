// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Box, point spacing and number of invalid points of a cloud.
#pragma once

#include <cstddef>
#include <optional>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/aabb.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Statistics of a cloud, e.g. to choose a range, a tolerance or a file reader.
struct CloudStatistics {
  /// Box around the valid points that are not exactly at (0, 0, 0); empty if there are no such points.
  Aabb box;
  /// Typical distance from a point to its nearest neighbour, in the unit of the points.
  std::optional<double> spacing;
  /// Number of points that are not valid (is_valid()).
  std::size_t nonfinite = 0;
  /// Number of points exactly at (0, 0, 0). Such points are most likely rays without a return.
  std::size_t zero = 0;
};

/// Computes the statistics of a cloud, with three passes over all points.
///
/// The box and the spacing ignore invalid points and points at (0, 0, 0). The spacing is the median, over at
/// most 1000 evenly selected points, of the exact distance to the nearest other point. The spacing is missing
/// if fewer than two points are left. The cost is O(n) if the spacing is similar in all parts of the cloud.
CloudStatistics cloud_statistics(const PointView& points, const Execution& execution = {});

}  // namespace pcl_bv
