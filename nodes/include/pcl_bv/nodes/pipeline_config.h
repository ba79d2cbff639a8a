// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The configuration of a pipeline as plain data.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/segmentation/clusters.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Volumes that the filter uses to drop points: a robot's own links, for example, or a region to crop to.
struct RegionConfig {
  std::filesystem::path file;  ///< File of volumes (read_volumes()), read if `volumes` is empty.
  /// false: points inside are dropped. true: points outside all regions with `keep` are dropped.
  bool keep = false;
  double padding = 0;  ///< Inflation of the volumes in every direction, metres (trees/region_mask.h).
  std::vector<AnyVolume> volumes{};
};

/// Which points enter the pipeline. Points that are not finite are always dropped.
struct FilterConfig {
  /// Smallest and largest allowed distance from the origin, metres. Many drivers store beams without a return
  /// as points at the origin. If range_min is 0, these points become one huge cluster.
  double range_min = 0.5;
  double range_max = std::numeric_limits<double>::infinity();
  /// Corners of a box around the own vehicle, metres. Points inside are dropped. Set both corners or neither.
  std::optional<Eigen::Vector3d> own_box_min, own_box_max;
  std::vector<RegionConfig> regions{};
};

/// How ground is removed.
enum class GroundMethod : std::uint8_t {
  none,
  plane,  ///< split_ground(): one plane, for indoor scenes.
  zones,  ///< GroundZones: many planes, for roads.
  slope   ///< split_ground_by_slope(): for maps, which have no position of a sensor.
};

/// Settings of the ground removal.
struct GroundConfig {
  GroundMethod method = GroundMethod::zones;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< Direction against gravity; any length above 0.
  /// Sensor position in the frame of the points, metres. Ground zones are centred there. If not given, the
  /// position is chosen as described at FrameResult::sensor.
  std::optional<Eigen::Vector3d> sensor;
  /// Height of the sensor (`zones`) or of the origin (`plane`) above the ground, metres. If not given, the
  /// height is estimated. With `zones`, the height is ignored if the sensor's position is estimated (case 5
  /// of FrameResult::sensor).
  std::optional<double> sensor_height;
  /// Largest height of ground points above the ground surface, metres. If not given, the default of the
  /// method (GroundPlaneOptions, GroundZonesOptions, GroundSlopeOptions).
  std::optional<double> distance;
  /// Largest angle between the ground and the horizontal, degrees. If not given, the default of the method.
  std::optional<double> max_slope_degrees;
  /// Side of the cells of `slope`, metres. If not given, the default of GroundSlopeOptions.
  std::optional<double> cell_size{};
};

/// The name of a field of a cloud.
struct FieldName {
  std::string name;
};

/// Lengths of the three sides of an upright box, metres.
struct UprightSize {
  double along = 0;   ///< The longer horizontal side.
  double across = 0;  ///< The shorter horizontal side.
  double up = 0;      ///< The side along GroundConfig::up.
};

/// Settings for the objects of one class. Unset fields inherit ClusterConfig and PipelineConfig::volumes.
struct ClassConfig {
  std::int64_t value = 0;             ///< Value of the class field.
  bool drop = false;                  ///< Drop the points of this class.
  std::optional<double> tolerance{};  ///< As ClusterConfig::tolerance, above 0.
  std::optional<std::size_t> min_size{}, max_size{};
  std::vector<std::string> volumes{};  ///< Methods. If empty: PipelineConfig::volumes.
  std::string name{};                  ///< Such as "car", for programs that show names; may be empty.
};

/// How the objects of clusters are separated, and parts of objects are joined, after the clustering.
enum class Refine : std::uint8_t {
  automatic,  ///< `tracks` if tracking is on, otherwise `off`.
  off,        ///< Each cluster is one object.
  /// People are cut out of clusters, at the necks between them and the rest. A person is a peak of the
  /// density of points seen from above, 0.9 m to 2.3 m high, at most 1.1 m wide, and of at least min_size
  /// points.
  neck,
  /// As `neck`. Besides, tracked people are cut out of clusters, also if they would not be recognised in one
  /// frame, and clusters inside the box of a tracked vehicle are joined. Without tracking: as `neck`.
  tracks
};

/// Settings of the clustering.
struct ClusterConfig {
  /// Points closer to each other than this belong to one object, metres. 0: all points are one object.
  double tolerance = 0.5;
  /// Objects with fewer points are dropped. If not given: 10, or 0 if `tolerance` is 0.
  std::optional<std::size_t> min_size;
  /// Largest number of points of an object. `oversized` determines what happens to objects with more points.
  std::size_t max_size = std::numeric_limits<std::size_t>::max();
  /// Core condition of DBSCAN (Ester et al. 1996). Two points within the tolerance belong to one object only
  /// if at least one of them is a core point. A core point has at least `min_points` points within the
  /// tolerance, itself included. With 1, every point is a core point.
  std::size_t min_points = 1;
  /// Growth of the tolerance with the distance from the origin, metres per metre (ClusterOptions).
  double tolerance_per_metre = 0;
  Oversized oversized = Oversized::drop;  ///< How objects above max_size are treated.
  Refine refine = Refine::automatic;      ///< Only with a tolerance above 0.
  /// Objects whose upright box is smaller (larger) than this along any axis are dropped, and their points are
  /// counted as small (large). The box is that of obb-yaw. An object that is too small along one axis and too
  /// large along another one counts as small. If not given: no limit. `max_extent` may be infinite along
  /// single axes. Both apply to all classes, after `oversized` and `refine`, and need a tolerance above 0.
  std::optional<UprightSize> min_extent{}, max_extent{};
  /// Integer field of the clouds that holds the points' classes. If set, all points of an object have the
  /// same class.
  std::optional<FieldName> class_field{};
  std::vector<ClassConfig> classes{};  ///< Settings of single classes; only with `class_field`.

  /// Returns `min_size` or, if not given, its default.
  std::size_t effective_min_size() const { return min_size.value_or(tolerance > 0 ? 10 : 0); }
};

/// Settings of the tracking (Tracker).
struct TrackConfig {
  bool enabled = false;
  double gate = 2.0;      ///< Largest distance of an object from its expected position, metres; 100 or less.
  std::size_t birth = 3;  ///< Detections after which an object gets its id.
  std::size_t death = 8;  ///< Frames without a detection after which a track is deleted.
  bool smooth = false;    ///< Smooth the yaw of upright boxes over time. The boxes still contain all points.
  bool grow = false;      ///< Give upright boxes the largest length and width seen of the object.
  /// With `grow`, give upright boxes of what may be one side of a vehicle at least the size of a small car,
  /// 3.9 m x 1.6 m. For roads; needs z up.
  bool vehicles = true;
};

/// A function that returns the name of a setting in messages, such as the option "--up" of a command. `key`
/// is the key of the setting in the configuration file, such as "ground.up".
using SettingName = std::function<std::string(std::string_view key)>;

/// The SettingName for messages that name settings by their keys.
inline std::string key_of_setting(std::string_view key) {
  return std::string(key);
}

/// Whether the points of a sweep are moved to where the sensor would have measured them at the frame's stamp.
/// A sensor that drives at 15 m/s moves by 1.5 m within a sweep.
enum class Deskew : std::uint8_t {
  off,        ///< The points are used as measured.
  on,         ///< Moves them, and warns if this is not possible.
  automatic,  ///< Moves them if they have times and the motion of the sensor is known.
};

/// The complete configuration of a FramePipeline.
struct PipelineConfig {
  FilterConfig filter;
  /// Moves points by their own times (Frame::times), after the filter. Needs ground removal or clustering,
  /// and points in the frame of the sensor. The motion comes from poses, otherwise from the tracker. Volumes
  /// enclose the moved points (FrameResult::cloud_of()).
  Deskew deskew = Deskew::off;
  GroundConfig ground;
  ClusterConfig cluster;
  /// Names of methods (fitting/methods.h). If empty: obb-lshape, or aabb, sphere and obb if cluster.tolerance
  /// is 0.
  std::vector<std::string> volumes;
  SphereGrowth growth = SphereGrowth::deferred;  ///< Policy of sphere-ritter and sphere-epos*.
  /// Outlines of prisms follow bays wider than this, metres (PrismOptions). If not given: outlines are
  /// convex.
  std::optional<double> concave_length{};
  TrackConfig track;
  std::size_t threads = 1;   ///< Number of threads; 0: all processors.
  std::string isa = "auto";  ///< Instruction set, a name that parse_isa() knows.

  /// Returns one line for each value that is not allowed. The line has the key as in the configuration file,
  /// the value and the allowed range. If each single value is allowed, returns one line for each combination
  /// of values that is not allowed.
  std::vector<std::string> validate() const;

  /// Returns a warning for each setting that has no effect in combination with the others, such as
  /// "track.smooth: has no effect without track.enabled". Such settings are allowed.
  std::vector<std::string> ineffective_settings(const SettingName& name = key_of_setting) const;

  /// Returns the union of the methods of all objects: first those of `volumes`, then further ones of
  /// cluster.classes. Unknown names are skipped.
  std::vector<const Method*> methods() const;

  /// Returns the methods for objects of one class. `own` is the entry of cluster.classes for this class; null
  /// if there is none, or if points have no classes.
  std::vector<const Method*> methods_of(const ClassConfig* own) const;

  /// Returns the execution for `threads` and `isa`. Throws std::invalid_argument if `isa` is not usable.
  Execution execution() const;
  Refine effective_refine() const;       ///< Not `automatic`.
  MethodOptions method_options() const;  ///< `up` has length 1.
};

/// Returns a configuration that suits any cloud: no filter, no ground removal, all points in one object,
/// threads on all processors.
PipelineConfig whole_cloud_config();

/// Replaces the filter, ground and cluster settings, and `track.vehicles`, by a preset:
/// - "road": a LiDAR on a vehicle, z up (the defaults, with a tolerance that grows by 1 % of the distance);
/// - "indoor": a LiDAR on a robot in rooms, z up;
/// - "table": objects on a table below a depth camera that looks down at them, in the camera's optical frame
///   (z forward, y down).
///
/// Throws std::invalid_argument for another name.
void apply_preset(std::string_view name, PipelineConfig& config);

}  // namespace pcl_bv
