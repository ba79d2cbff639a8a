// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "references.h"

#include <algorithm>

namespace pcl_bv {

SlabExtents slab_extents_reference(const PointView& points, const Coordinates& origin,
                                   const std::array<Direction, 3>& axes) {
  SlabExtents result;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    const double x = p.x - origin.x, y = p.y - origin.y, z = p.z - origin.z;
    for (std::size_t k = 0; k < 3; ++k) {
      const double s = (axes[k][0] * x + axes[k][1] * y) + axes[k][2] * z;
      result.low[k] = std::min(result.low[k], s);
      result.high[k] = std::max(result.high[k], s);
    }
  }
  return result;
}

}  // namespace pcl_bv
