// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Detects that a source's points changed between the passes of a fit. Each pass compares its points with the
// results of the first pass. Without this check, changed points could be outside the range that the first
// pass found, or could leave a list empty that must have elements.
#pragma once

#include <stdexcept>

#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {

/// Throws std::invalid_argument unless `same`.
inline void require_same_points(bool same) {
  if (!same) throw std::invalid_argument("the points changed while they were fitted");
}

/// Returns whether a point is in the bounding box of all points.
inline bool within(const Supports& all, const Coordinates& p) {
  return p.x >= all.along[0].low && p.x <= all.along[0].high && p.y >= all.along[1].low &&
         p.y <= all.along[1].high && p.z >= all.along[2].low && p.z <= all.along[2].high;
}

/// Calls visit(index, p) for the valid points of a view of at most kChunkPoints points. Throws
/// std::invalid_argument if a point is outside the box of `all`, or if the number of valid points is not
/// all.used.
template <typename Visit>
void for_each_valid(const PointView& points, const Supports& all, const Visit& visit) {
  const LoadedPoints loaded(points, 0, points.count);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(loaded.view(), i);
    if (!is_valid(p)) continue;
    require_same_points(within(all, p));
    ++valid;
    visit(loaded.view().index(i), p);
  }
  require_same_points(valid == all.used);
}

}  // namespace pcl_bv::detail
