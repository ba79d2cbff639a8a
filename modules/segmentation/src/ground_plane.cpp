// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/ground_plane.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "ground_checks.h"
#include "ground_sample.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/numeric/vector3.h"
#include "plane_search.h"

namespace pcl_bv {
namespace {

constexpr std::array<std::string_view, 6> axis_names{"x", "y", "z", "-x", "-y", "-z"};

void check(const GroundPlaneSettings& settings) {
  constexpr const char* who = "ground plane";
  check_ground(who, settings.distance, settings.max_slope_degrees, settings.sensor_height);
  require(settings.iterations >= 1 && settings.iterations <= 1'000'000, who, "iterations",
          settings.iterations, "1 to 1000000");
}

// Every number is written to both lists, and kept in one by moving its end: half the time of a branch that a
// cloud in scan order makes unpredictable.
void classify(const PointView& points, double distance, GroundSplit& split) {
  split.ground.resize(points.count);
  split.rest.resize(points.count);
  const Plane plane{split.normal, split.offset};
  std::size_t ground = 0;
  std::size_t rest = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Coordinates p = load_point(points, i);
    if (!is_valid(p)) continue;
    const bool is_ground = split.found && height_above(plane, {p.x, p.y, p.z}) <= distance;
    split.ground[ground] = split.rest[rest] = static_cast<std::int32_t>(points.index(i));
    ground += is_ground;
    rest += !is_ground;
  }
  split.ground.resize(ground);
  split.rest.resize(rest);
}

}  // namespace

UpAxis parse_up_axis(std::string_view text) {
  const auto* const found = std::find(axis_names.begin(), axis_names.end(), text);
  if (found == axis_names.end()) {
    throw std::invalid_argument("up axis is \"" + std::string(text) + "\", must be x, y, z, -x, -y or -z");
  }
  return static_cast<UpAxis>(found - axis_names.begin());
}

Eigen::Vector3d up_direction(UpAxis axis) {
  const int number = static_cast<int>(axis);
  return number < 3 ? Eigen::Vector3d::Unit(number) : Eigen::Vector3d(-Eigen::Vector3d::Unit(number - 3));
}

void split_ground(const PointView& points, const GroundPlaneSettings& settings, GroundSplit& split) {
  const FloatEnvironment environment;
  check(settings);
  check_numbers(points);
  const Eigen::Vector3d origin = sample_ground(points, settings.up, settings.seed, split.scratch);
  const std::optional<Plane> plane = find_ground_plane(split.scratch, -origin, settings);
  split.found = plane.has_value();
  split.normal = plane ? plane->normal : Eigen::Vector3d::Zero();
  split.offset = plane ? plane->offset + dot3(plane->normal, origin) : 0;
  classify(points, settings.distance, split);
}

}  // namespace pcl_bv
