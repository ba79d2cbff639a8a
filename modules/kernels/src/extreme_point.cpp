// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A rounded sum rejects nearly all points; the few that remain are compared exactly.

#include "pcl_bv/kernels/extreme_point.h"

namespace pcl_bv {
namespace {

template <typename T>
void find(const PointView& points, const std::array<std::int8_t, 3>& direction, double threshold,
          ExtremePoint& best) {
  const T a = direction[0];
  const T b = direction[1];
  const T c = direction[2];
  for (std::size_t i = 0; i < points.count; ++i) {
    T v[3];
    std::memcpy(v, points.address(i), sizeof v);
    const T rounded = (a * v[0] + b * v[1]) + c * v[2];
    if (!(rounded >= threshold)) continue;
    const Coordinates point{v[0], v[1], v[2]};
    if (!is_valid(point)) continue;
    const ExactSum projection = exact_projection(direction, point);
    const int order = best.found ? compare(projection, best.projection) : 1;
    const std::size_t index = points.index(i);
    if (order > 0 || (order == 0 && index < best.index)) best = {true, projection, point, index};
  }
}

}  // namespace

void find_extreme_point(const PointView& points, const std::array<std::int8_t, 3>& direction,
                        double threshold, ExtremePoint& best) {
  if (points.scalar == ScalarType::float32) return find<float>(points, direction, threshold, best);
  find<double>(points, direction, threshold, best);
}

}  // namespace pcl_bv
