// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Checks of ground options and point indices.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "pcl_bv/numeric/coordinates.h"
#include "pcl_bv/points/point_view.h"

namespace pcl_bv::detail {

/// Throws std::invalid_argument unless `in_range`. The message has `who`, the setting, its value and the
/// range.
inline void require(bool in_range, const char* who, const char* name, double value, const char* range) {
  if (in_range) return;
  throw std::invalid_argument(std::string(who) + ": " + name + " is " + std::to_string(value) + ", must be " +
                              range);
}

/// Checks the options that split_ground() and GroundZones share.
inline void check_ground(const char* who, double distance, double max_slope_degrees,
                         std::optional<double> sensor_height) {
  constexpr double largest = std::numeric_limits<double>::max();
  const double height = sensor_height.value_or(0);
  require(distance > 0 && distance <= largest, who, "distance", distance, "finite and greater than 0");
  require(max_slope_degrees >= 0 && max_slope_degrees <= 89, who, "max_slope_degrees", max_slope_degrees,
          "0 to 89");
  require(height >= 0 && height <= largest, who, "sensor_height", height, "finite and at least 0");
}

/// Checks the position of a sensor.
inline void check_sensor(const char* who, const Eigen::Vector3d& sensor) {
  for (const double coordinate : sensor)
    require(std::abs(coordinate) <= kMaxCoordinate, who, "a coordinate of sensor", coordinate,
            "from -1e100 to 1e100");
}

/// Throws std::length_error if a point index exceeds 2^31 - 1. Views with an index list need no check,
/// because their indices are 32-bit integers.
inline void check_indices(const PointView& points) {
  constexpr std::size_t max_index = std::numeric_limits<std::int32_t>::max();
  if (points.indices || points.empty() || points.first + points.count - 1 <= max_index) return;
  throw std::length_error("point index " + std::to_string(points.first + points.count - 1) +
                          " is too large, must be at most 2147483647");
}

}  // namespace pcl_bv::detail
