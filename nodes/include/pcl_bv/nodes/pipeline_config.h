// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Everything that a pipeline can be told, as plain data.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/segmentation/euclidean_clusters.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Volumes that points are dropped for: a robot's own links, or what to crop to.
struct RegionConfig {
  std::filesystem::path file;  ///< Read by read_volumes(), unless `volumes` has some.
  bool keep = false;           ///< Drop what is outside of all such regions; otherwise what is inside.
  double padding = 0;  ///< By which the volumes are grown in every direction, metres (trees/region_mask.h).
  std::vector<AnyVolume> volumes{};
};

/// Points that are kept at all. Those that are not finite never are.
struct FilterConfig {
  /// Distances from the origin that are kept, metres, both ends included. Dead beams are points at the
  /// origin: with a minimum of 0 they become one giant cluster.
  double range_min = 0.5;
  double range_max = std::numeric_limits<double>::infinity();
  /// Corners of a box around the own vehicle, metres, whose points are dropped; both or none.
  std::optional<Eigen::Vector3d> own_box_min, own_box_max;
  std::vector<RegionConfig> regions{};
};

enum class GroundMethod : std::uint8_t {
  none,
  plane,  ///< split_ground(): one plane, for indoor scenes.
  zones   ///< GroundZones: many planes, for roads.
};

struct GroundConfig {
  GroundMethod method = GroundMethod::zones;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Against gravity; of any length.
  /// Where the sensor is in the frame of the points, metres; if not given, in its origin. The centre of
  /// zones.
  std::optional<Eigen::Vector3d> sensor;
  /// Of the sensor (with a plane: of the origin) above the ground, metres; learnt if not given.
  std::optional<double> sensor_height;
  /// Points at most this far above the ground belong to it, metres; if not given, what the method's settings
  /// say.
  std::optional<double> distance;
  /// Greatest angle between the ground and the horizontal; if not given, what the method's settings say.
  std::optional<double> max_slope_degrees;
};

struct FieldName {
  std::string name;
};

/// What is special about the objects of one class; what is not said is as for the others.
struct ClassConfig {
  std::int64_t value = 0;             ///< Of the class field.
  bool drop = false;                  ///< Its points are in no object.
  std::optional<double> tolerance{};  ///< Metres, above 0.
  std::optional<std::size_t> min_size{}, max_size{};
  std::vector<std::string> volumes{};  ///< Methods.
};

struct ClusterConfig {
  double tolerance = 0.5;  ///< Points nearer to each other are one object, metres; 0: all points are one.
  /// Points; smaller objects are dropped. If not given 10, and 0 where all points are one.
  std::optional<std::size_t> min_size;
  std::size_t max_size = std::numeric_limits<std::size_t>::max();  ///< Points; larger ones are dropped.
  /// DBSCAN: points nearer to each other than the tolerance are one object only if one of them has so many
  /// points nearer than that, itself included; 1: always.
  std::size_t min_points = 1;
  /// By how much the tolerance grows with the distance from the origin (ClusterSettings).
  double tolerance_per_metre = 0;
  Oversized oversized = Oversized::drop;  ///< What becomes of objects above max_size.
  /// Field of the clouds, of integers, whose values are the points' classes: objects are of one class each.
  std::optional<FieldName> class_field{};
  std::vector<ClassConfig> classes{};  ///< Those that differ from the others; only with `class_field`.

  std::size_t least_size() const { return min_size.value_or(tolerance > 0 ? 10 : 0); }
};

struct TrackConfig {
  bool enabled = false;
  double gate = 2.0;      ///< How far an object may be from where it was expected, metres, at most 100.
  std::size_t birth = 3;  ///< Frames in which an object must have been seen to get its id.
  std::size_t death = 5;  ///< Frames without it after which it is gone.
  bool smooth = false;    ///< Upright boxes turn with the mean over time, still around all points.
  bool grow = false;      ///< Upright boxes are as long and wide as the object has been seen.
};

struct PipelineConfig {
  FilterConfig filter;
  GroundConfig ground;
  ClusterConfig cluster;
  /// Methods of fitting/methods.h; if empty, obb-lshape, and aabb, sphere, obb where all points are one
  /// object.
  std::vector<std::string> volumes;
  SphereGrowth growth = SphereGrowth::deferred;  ///< Of spheres that grow.
  TrackConfig track;
  std::size_t threads = 1;   ///< 0: all processors.
  std::string isa = "auto";  ///< Instruction set, by the names of parse_isa().

  /// One line for each value that is not allowed: the key as in the configuration file, the value, the range.
  std::vector<std::string> validate() const;

  /// One line for each setting that changes nothing beside the others, as "track.smooth: has no effect
  /// without track.enabled": for a warning, none is an error.
  std::vector<std::string> without_effect() const;

  /// What `volumes` stands for, then what only classes have; methods that are unknown are left out.
  std::vector<const Method*> methods() const;

  /// Those of objects of one class; null: of objects of no class, or of one of which nothing is said.
  std::vector<const Method*> methods_of(const ClassConfig* own) const;

  /// What `threads` stands for.
  ParallelPolicy policy() const;
};

/// For clouds of which nothing is known: no filter, no ground, all points one object, all processors.
PipelineConfig whole_cloud_config();

/// Filter, ground and clusters to begin with: "road" (a LiDAR on a vehicle, z up: the defaults), "indoor"
/// (the same on a robot in rooms), or "table" (things on a table before a depth camera that looks down at
/// them, in its optical frame: z forward, y down). Throws std::invalid_argument for another name.
void apply_preset(std::string_view name, PipelineConfig& config);

}  // namespace pcl_bv
