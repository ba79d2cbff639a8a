// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Everything that a pipeline can be told, as plain data.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/segmentation/ground_plane.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Points that are kept at all. Those that are not finite never are.
struct FilterConfig {
  /// Distances from the origin that are kept, metres, both ends included. Dead beams are points at the
  /// origin: with a minimum of 0 they become one giant cluster.
  double range_min = 0.5;
  double range_max = std::numeric_limits<double>::infinity();
  /// Corners of a box around the own vehicle, metres, whose points are dropped; both or none.
  std::optional<Eigen::Vector3d> own_box_min, own_box_max;
};

enum class GroundMethod : std::uint8_t {
  none,
  plane,  ///< split_ground(): one plane, for indoor scenes.
  zones   ///< GroundZones: many planes, for roads.
};

/// Reads "none", "plane" or "zones"; anything else throws std::invalid_argument naming these.
GroundMethod parse_ground_method(std::string_view text);
std::string_view name_of(GroundMethod method);

struct GroundConfig {
  GroundMethod method = GroundMethod::zones;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Against gravity; any length above 0.
  std::optional<double> sensor_height;  ///< Of the origin above the ground, metres; learnt if not given.
  /// Points at most this far above the ground belong to it, metres; if not given, what the method's settings
  /// say.
  std::optional<double> distance;
  /// Greatest angle between the ground and the horizontal; if not given, what the method's settings say.
  std::optional<double> max_slope_degrees;
};

struct ClusterConfig {
  double tolerance = 0.5;     ///< Points nearer to each other are one object, metres; 0: all points are one.
  std::size_t min_size = 10;  ///< Points; smaller objects are dropped.
  std::size_t max_size = std::numeric_limits<std::size_t>::max();  ///< Points; larger ones are dropped.
};

struct TrackConfig {
  bool enabled = false;
  double gate = 2.0;      ///< How far an object may be from where it was expected, metres, at most 100.
  std::size_t birth = 3;  ///< Frames in which an object must have been seen to get its id.
  std::size_t death = 5;  ///< Frames without it after which it is gone.
};

struct PipelineConfig {
  FilterConfig filter;
  GroundConfig ground;
  ClusterConfig cluster;
  std::vector<std::string> volumes{"aabb", "sphere", "obb-yaw"};  ///< Methods of fitting/methods.h.
  TrackConfig track;
  std::size_t threads = 1;   ///< 0: all processors.
  std::string isa = "auto";  ///< Instruction set, by the names of parse_isa().

  /// One line for each value that is not allowed: the key as in the configuration file, the value, the range.
  std::vector<std::string> validate() const;
};

}  // namespace pcl_bv
