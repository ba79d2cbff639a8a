// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The directions checked, the points found turned into numbers.

#include "pcl_bv/fitting/extreme_points.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "farthest_points.h"
#include "pcl_bv/kernels/float_environment.h"

namespace pcl_bv {
namespace {

ProjectionSet checked(const std::vector<std::array<double, 3>>& directions) {
  if (directions.empty() || directions.size() > kMaxProjections) {
    throw std::invalid_argument("find_extreme_points: " + std::to_string(directions.size()) +
                                " directions, must be 1 to " + std::to_string(kMaxProjections));
  }
  ProjectionSet set;
  for (const Direction& d : directions) {
    const double largest = std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
    const bool finite = std::isfinite(d[0]) && std::isfinite(d[1]) && std::isfinite(d[2]);
    if (!finite || largest < 1e-30 || largest > 1e30) {
      throw std::invalid_argument("find_extreme_points: direction " + std::to_string(set.count) +
                                  " must be finite with its largest component from 1e-30 to 1e30");
    }
    set.add(d);
  }
  return set;
}

DirectionExtremes extremes_along(const Direction& n, const FarthestPoint& low, const FarthestPoint& high) {
  return {project_down(n, low.point), project_up(n, high.point), compare_along(n, low.point, high.point) == 0,
          low, high};
}

}  // namespace

ExtremePoints find_extreme_points(const PointView& points,
                                  const std::vector<std::array<double, 3>>& directions,
                                  const Execution& execution) {
  const FloatEnvironment environment;
  resolve_isa(execution.isa);  // throws before the directions do
  const ProjectionSet set = checked(directions);
  const ChunkFarthest all = find_farthest(points, set, execution);
  ExtremePoints result{points.count - all.dropped, all.dropped, {}};
  for (std::size_t k = 0; k < set.count && result.used > 0; ++k)
    result.along.push_back(extremes_along(set.exact[k], all.ends[2 * k], all.ends[2 * k + 1]));
  return result;
}

}  // namespace pcl_bv
