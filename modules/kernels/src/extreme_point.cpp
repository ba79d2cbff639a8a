// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A rounded sum rejects nearly all points; the few that remain are compared exactly.

#include "pcl_bv/kernels/extreme_point.h"

#include <stdexcept>
#include <string>

#include "passing_points.h"
#include "preconditions.h"

namespace pcl_bv {
namespace {

void consider(const CubeDirection& direction, const Coordinates& point, std::size_t index,
              ExtremePoint& best) {
  // Many equal points (a cloud of one value, dead beams) need no arithmetic.
  if (best.found && point == best.point) {
    if (index < best.index) best.index = index;
    return;
  }
  if (is_valid(point)) keep_extreme({true, exact_projection(direction, point), point, index}, best);
}

}  // namespace

void keep_extreme(const ExtremePoint& other, ExtremePoint& best) {
  if (!other.found) return;
  const int order = best.found ? compare(other.projection, best.projection) : 1;
  if (order > 0 || (order == 0 && other.index < best.index)) best = other;
}

void find_extreme_point(const PointView& points, std::size_t first, std::size_t step, std::size_t end,
                        const CubeDirection& direction, const RoundedFilter& filter, ExtremePoint& best) {
  require_in_memory(points);
  if (end > points.count) {
    throw std::out_of_range("find_extreme_point: end " + std::to_string(end) + " is behind the view's " +
                            std::to_string(points.count) + " points");
  }
  const Direction along = {static_cast<double>(direction[0]), static_cast<double>(direction[1]),
                           static_cast<double>(direction[2])};
  const auto look = [&](const Coordinates& point, std::size_t index) {
    consider(direction, point, index, best);
  };
  if (points.scalar == ScalarType::float32) {
    for_each_passing<float>(points, first, step, end, along, filter, look);
  } else {
    for_each_passing<double>(points, first, step, end, along, filter, look);
  }
}

}  // namespace pcl_bv
