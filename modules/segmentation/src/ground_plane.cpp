// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/ground.h"

#include "ground_checks.h"
#include "pcl_bv/numeric/float_environment.h"
#include "plane_search.h"

namespace pcl_bv {
using namespace detail;
namespace {

void check(const GroundPlaneOptions& options) {
  constexpr const char* who = "ground plane";
  check_ground(who, options.distance, options.max_slope_degrees, options.sensor_height);
  check_sensor(who, options.sensor);
  require(options.iterations >= 1 && options.iterations <= 1'000'000, who, "iterations", options.iterations,
          "1 to 1000000");
}

}  // namespace

void split_ground(const PointView& points, const GroundPlaneOptions& options, GroundSplit& split) {
  const FloatEnvironment environment;
  check(options);
  check_indices(points);
  const std::optional<Plane> plane = find_ground_plane(points, options.sensor, options, split.scratch);
  write_split(plane, points.count, split, [&](const auto& put) {
    for (std::size_t i = 0; i < points.count; ++i) {
      const Coordinates p = load_point(points, i);
      if (!is_valid(p)) continue;
      put(static_cast<std::int32_t>(points.index(i)),
          plane && height_above(*plane, {p.x, p.y, p.z}) <= options.distance);
    }
  });
}

GroundSplit split_ground(const PointView& points, const GroundPlaneOptions& options) {
  GroundSplit split;
  split_ground(points, options, split);
  return split;
}

}  // namespace pcl_bv
