// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/ground_plane.h"

#include "ground_checks.h"
#include "pcl_bv/numeric/float_environment.h"
#include "plane_search.h"

namespace pcl_bv {
namespace {

void check(const GroundPlaneSettings& settings) {
  constexpr const char* who = "ground plane";
  check_ground(who, settings.distance, settings.max_slope_degrees, settings.sensor_height);
  require(settings.iterations >= 1 && settings.iterations <= 1'000'000, who, "iterations",
          settings.iterations, "1 to 1000000");
}

}  // namespace

void split_ground(const PointView& points, const GroundPlaneSettings& settings, GroundSplit& split) {
  const FloatEnvironment environment;
  check(settings);
  check_indices(points);
  const std::optional<Plane> plane =
      find_ground_plane(points, Eigen::Vector3d::Zero(), settings, split.scratch);
  write_split(plane, points.count, split, [&](const auto& put) {
    for (std::size_t i = 0; i < points.count; ++i) {
      const Coordinates p = load_point(points, i);
      if (!is_valid(p)) continue;
      put(static_cast<std::int32_t>(points.index(i)),
          plane && height_above(*plane, {p.x, p.y, p.z}) <= settings.distance);
    }
  });
}

}  // namespace pcl_bv
