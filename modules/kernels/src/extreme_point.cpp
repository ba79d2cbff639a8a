// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A rounded sum rejects nearly all points; the few that remain are compared exactly.

#include "pcl_bv/kernels/extreme_point.h"

namespace pcl_bv {
namespace {

bool same(const Coordinates& a, const Coordinates& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

void consider(const CubeDirection& direction, const Coordinates& point, std::size_t index,
              ExtremePoint& best) {
  // Many equal points (a cloud of one value, dead beams) need no arithmetic.
  if (best.found && same(point, best.point)) {
    if (index < best.index) best.index = index;
    return;
  }
  if (is_valid(point)) keep_extreme({true, exact_projection(direction, point), point, index}, best);
}

template <typename T>
void find(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
          const CubeDirection& direction, const RoundedFilter& filter, ExtremePoint& best) {
  const T a = direction[0];
  const T b = direction[1];
  const T c = direction[2];
  const T center[3] = {static_cast<T>(filter.center.x), static_cast<T>(filter.center.y),
                       static_cast<T>(filter.center.z)};
  for (std::size_t i = first; i < end; i += step) {
    T v[3];
    load_point(points, i, v);
    const T rounded = (a * (v[0] - center[0]) + b * (v[1] - center[1])) + c * (v[2] - center[2]);
    if (rounded < filter.threshold) continue;  // an overflown sum may be NaN
    consider(direction, {v[0], v[1], v[2]}, points.index(i), best);
  }
}

}  // namespace

void keep_extreme(const ExtremePoint& other, ExtremePoint& best) {
  if (!other.found) return;
  const int order = best.found ? compare(other.projection, best.projection) : 1;
  if (order > 0 || (order == 0 && other.index < best.index)) best = other;
}

void find_extreme_point(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
                        const CubeDirection& direction, const RoundedFilter& filter, ExtremePoint& best) {
  if (points.scalar == ScalarType::float32) {
    find<float>(points, first, step, end, direction, filter, best);
  } else {
    find<double>(points, first, step, end, direction, filter, best);
  }
}

}  // namespace pcl_bv
