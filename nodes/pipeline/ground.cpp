// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Settings that are not given in the configuration keep the defaults of the method.

#include "ground.h"

namespace pcl_bv {
using namespace detail;
namespace {

template <typename Settings>
Settings settings_of(const GroundConfig& config) {
  Settings settings;
  settings.up = config.up;
  if constexpr (requires { settings.sensor_height; }) settings.sensor_height = config.sensor_height;
  settings.distance = config.distance.value_or(settings.distance);
  settings.max_slope_degrees = config.max_slope_degrees.value_or(settings.max_slope_degrees);
  return settings;
}

}  // namespace

GroundPlaneOptions detail::plane_settings(const GroundConfig& config) {
  return settings_of<GroundPlaneOptions>(config);
}

GroundSlopeOptions detail::slope_settings(const GroundConfig& config) {
  auto settings = settings_of<GroundSlopeOptions>(config);
  settings.cell_size = config.cell_size.value_or(settings.cell_size);
  return settings;
}

void detail::split_ground(const PointView& points, const GroundConfig& config, const SensorPosition& sensor,
                          const Eigen::Vector3d& origin, const Execution& execution, GroundZones& zones,
                          GroundSplit& split) {
  split.found = false;
  split.ground.clear();
  split.rest.clear();
  if (config.method == GroundMethod::plane) {
    GroundPlaneOptions settings = plane_settings(config);
    settings.sensor = origin;
    split_ground(points, settings, split);
  } else if (config.method == GroundMethod::zones) {
    auto settings = settings_of<GroundZonesOptions>(config);
    settings.sensor = sensor.position;
    if (!sensor.confirmed && !config.sensor) settings.sensor_height.reset();
    zones.split(points, settings, split, execution);
  } else if (config.method == GroundMethod::slope) {
    split_ground_by_slope(points, slope_settings(config), split, execution);
  }
}

}  // namespace pcl_bv
