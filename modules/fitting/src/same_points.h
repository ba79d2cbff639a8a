// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points of a source may change between the passes of a fit. What one pass found is held against the
// next, before a list that cannot be empty is, or numbers leave the range that the first pass has set.
#pragma once

#include <stdexcept>

#include "pcl_bv/fitting/supports.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv {

inline void require_same_points(bool same) {
  if (!same) throw std::invalid_argument("the points changed while they were fitted");
}

/// Whether a point is in the box of all points.
inline bool within(const Supports& all, const Coordinates& p) {
  return p.x >= all.along[0].low && p.x <= all.along[0].high && p.y >= all.along[1].low &&
         p.y <= all.along[1].high && p.z >= all.along[2].low && p.z <= all.along[2].high;
}

/// Calls visit(index, p) for the valid points of a view of at most kChunkPoints.
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

}  // namespace pcl_bv
