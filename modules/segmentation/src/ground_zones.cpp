// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "ground_checks.h"
#include "ground_surface.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/points/select_points.h"
#include "zone_points.h"

namespace pcl_bv {
using namespace detail;
namespace {

// Numbers of rings in which the plane around the sensor is searched: first within 12.5 m, where the ground is
// seen best and is flattest. If no plane is found there, the plane is searched within 25 m, then everywhere.
constexpr std::array<std::size_t, 3> central_rings{25, 50, ring_count};
constexpr unsigned plane_tries = 100;
constexpr std::size_t plane_sample =
    2048;  // 8192 points and 300 tries gave the same plane on recorded and generated sweeps

// Factor of `distance` in cells with an object. Without this factor the feet of walls, hedges and cars would
// be ground. These feet are 2 % of the points of a street scene.
constexpr double foot_share = 0.2;

void check(const GroundZonesOptions& options) {
  constexpr const char* who = "ground zones";
  check_ground(who, options.distance, options.max_slope_degrees, options.sensor_height);
  check_sensor(who, options.sensor.value_or(Eigen::Vector3d::Zero()));
}

}  // namespace

struct GroundZones::Scratch : ZonePoints {
  std::vector<std::int32_t> near;
  GroundSurface surface;

  std::optional<Plane> central_plane(const PointView& view, const GroundZonesOptions& options,
                                     const Eigen::Vector3d& sensor, std::optional<double> sensor_height,
                                     const ParallelPolicy& policy, GroundScratch& sample) {
    GroundPlaneOptions search;
    search.up = options.up;
    search.max_slope_degrees = options.max_slope_degrees;
    search.sensor_height = sensor_height;
    search.seed = options.seed;
    search.iterations = plane_tries;
    for (const std::size_t rings : central_rings) {
      list_near(rings, policy, near);
      if (auto plane = find_ground_plane(select_points(view, near), sensor, search, sample, plane_sample))
        return plane;
    }
    return {};
  }

  void classify(const std::optional<Plane>& central, double distance, const ParallelPolicy& policy,
                GroundSplit& split) {
    const std::array<float, 2> limit{static_cast<float>(distance), static_cast<float>(foot_share * distance)};
    set_plane(central, split);
    split.ground.resize(number.size());
    split.rest.resize(number.size());
    parts.for_each(policy, [&](ZonePart& part) {
      const auto visit = [&](const auto& put) {
        for (std::size_t i = part.begin; i < part.begin + part.valid; ++i)
          put(number[i], central && surface.clearance(*this, i) <= limit[surface.has_object(*this, i)]);
      };
      part.listed = write_lists(part.begin, split, visit).ground;
    });
    split.ground.resize(join_lists(parts, split.ground, [](const ZonePart& part) { return part.listed; }));
    split.rest.resize(
        join_lists(parts, split.rest, [](const ZonePart& part) { return part.valid - part.listed; }));
  }
};

GroundZones::GroundZones() = default;
GroundZones::~GroundZones() = default;
GroundZones::GroundZones(GroundZones&&) noexcept = default;
GroundZones& GroundZones::operator=(GroundZones&&) noexcept = default;

void GroundZones::split(const PointView& points, const GroundZonesOptions& options, GroundSplit& split,
                        const Execution& execution) {
  const FloatEnvironment environment;
  check(options);
  check_indices(points);
  if (!scratch_) scratch_ = std::make_unique<Scratch>();
  split.sensor = options.sensor ? SensorPosition{*options.sensor}
                                : find_sensor(points, options.up, Eigen::Vector3d::Zero(), split.scratch);
  const bool estimated = !options.sensor && !split.sensor.confirmed;
  const std::optional<double> height = estimated ? std::nullopt : options.sensor_height;
  const ZoneFrame frame(options.up, split.sensor.position);
  scratch_->read(points, frame, execution.parallel);
  std::optional<Plane> central = scratch_->central_plane(points, options, split.sensor.position, height,
                                                         execution.parallel, split.scratch);
  split.assumed_level = !central && height;
  if (split.assumed_level) central = frame.level(*height);
  if (central) {
    const Slope plane = frame.slope(*central);
    const double max_slope = std::tan(options.max_slope_degrees * std::numbers::pi / 180);
    scratch_->measure_from(plane, execution.parallel);
    scratch_->surface.find(scratch_->cells(), plane, static_cast<float>(max_slope));
  }
  scratch_->classify(central, options.distance, execution.parallel, split);
}

GroundSplit split_ground_by_zones(const PointView& points, const GroundZonesOptions& options,
                                  const Execution& execution) {
  GroundSplit split;
  GroundZones().split(points, options, split, execution);
  return split;
}

}  // namespace pcl_bv
