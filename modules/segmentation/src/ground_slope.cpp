// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <vector>

#include "ground_checks.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/segmentation/ground.h"
#include "pcl_bv/segmentation/slope_surface.h"
#include "plane_search.h"

namespace pcl_bv {
using namespace detail;

void split_ground_by_slope(const PointView& points, const GroundSlopeOptions& options, GroundSplit& split,
                           const Execution& execution) {
  check_indices(points);
  const SlopeSurface surface(points, options, execution);
  std::vector<std::uint8_t> ground(points.count);
  for_each_range(execution.parallel, points.count, kChunkPoints, [&](std::size_t begin, std::size_t end) {
    surface.classify(points.slice(begin, end - begin), ground.data() + begin);
  });
  write_split({}, points.count, split, [&](const auto& put) {
    for (std::size_t i = 0; i < points.count; ++i) {
      if (is_valid(load_point(points, i))) put(static_cast<std::int32_t>(points.index(i)), ground[i] != 0);
    }
  });
  split.found = surface.valid_points() > 0;
  split.sensor = {};
  split.assumed_level = false;
}

GroundSplit split_ground_by_slope(const PointView& points, const GroundSlopeOptions& options,
                                  const Execution& execution) {
  GroundSplit split;
  split_ground_by_slope(points, options, split, execution);
  return split;
}

}  // namespace pcl_bv
