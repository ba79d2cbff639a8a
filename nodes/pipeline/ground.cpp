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
  settings.sensor_height = config.sensor_height;
  settings.distance = config.distance.value_or(settings.distance);
  settings.max_slope_degrees = config.max_slope_degrees.value_or(settings.max_slope_degrees);
  return settings;
}

}  // namespace

GroundPlaneOptions detail::plane_settings(const GroundConfig& config) {
  return settings_of<GroundPlaneOptions>(config);
}

void detail::split_ground(const PointView& points, const GroundConfig& config, const SensorPosition& sensor,
                          const Execution& execution, GroundZones& zones, GroundSplit& split) {
  split.found = false;
  split.ground.clear();
  split.rest.clear();
  if (config.method == GroundMethod::plane) {
    split_ground(points, plane_settings(config), split);
  } else if (config.method == GroundMethod::zones) {
    auto settings = settings_of<GroundZonesOptions>(config);
    settings.sensor = sensor.position;
    if (!sensor.confirmed && !config.sensor) settings.sensor_height.reset();
    zones.split(points, settings, split, execution);
  }
}

}  // namespace pcl_bv
