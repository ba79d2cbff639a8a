// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The list of all settings with their keys, descriptions, units and allowed values. Configuration files,
// command-line options and the parameters of other systems are made by visiting this list.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();
inline constexpr double kFinite = std::numeric_limits<double>::max();

/// The range of allowed numbers, from `min` to `max`. `min` itself is allowed only if `closed` is true. `max`
/// is allowed and may be kNoLimit.
struct NumberRange {
  double min = 0;
  double max = kFinite;
  bool closed = true;
  /// Positive numbers that become 0 as float32, the type of points, are not allowed.
  bool as_float = false;
};

/// The part of an option's value that belongs to a setting, if the option sets several settings. Colons
/// separate the parts.
struct OptionPart {
  std::string_view name{};  ///< "MIN" of "--range MIN:MAX"; empty if the setting has an option of its own.
  bool last = true;
  bool optional = false;  ///< Whether the part may be missing, which means 0.
};

/// The description of a setting.
struct Setting {
  std::string_view key;                      ///< Key with its stage: "filter.range_min".
  std::string_view unit;                     ///< "m", the choices, or the meaning of a special value.
  std::string_view help;                     ///< Help text.
  NumberRange range{};                       ///< Allowed numbers.
  std::string_view unset{};                  ///< Meaning of null or of an empty list.
  std::string_view option{}, placeholder{};  ///< Such as "--sensor-height" and "M", or empty.
  OptionPart part{};  ///< Only the first part has a placeholder, which is that of the whole value.
};

// Tables of settings by stage, for visit_pipeline() and visit_stream().
// clang-format off
template <typename Filter, typename Visit>
void visit_filter(Filter& c, Visit&& visit) {
  using S = Setting;
  visit(S{"filter.range_min", "m", "Drop points nearer to the origin than this",
          {}, {}, "--range", "MIN:MAX", {"MIN", false}}, c.range_min);
  visit(S{"filter.range_max", "m", "Drop points farther from the origin than this",
          {0, kNoLimit}, {}, "--range", {}, {"MAX"}}, c.range_max);
  visit(S{"filter.own_box_min", "m, [x, y, z]", "Lower corner of a box of points to drop",
          {}, "no box"}, c.own_box_min);
  visit(S{"filter.own_box_max", "m, [x, y, z]", "Upper corner of a box of points to drop",
          {}, "no box"}, c.own_box_max);
  visit(S{"filter.regions", "[{file: F.json, keep: false, padding: 0 m}]",
          "Drop points inside volumes; keep: outside of all"}, c.regions);
}

template <typename Ground, typename Visit>
void visit_ground(Ground& c, Visit&& visit) {
  using S = Setting;
  visit(S{"ground.method", "none, plane, zones, slope",
          "Remove the ground first; zones: outdoors, slope: maps",
          {}, {}, "--ground", "KIND"}, c.method);
  visit(S{"ground.up", "x, y, z, -x, -y, -z or a vector X,Y,Z", "Up direction: x, y, z, -x, -y, -z or X,Y,Z",
          {}, {}, "--up", "AXIS"}, c.up);
  visit(S{"ground.sensor", "m, [x, y, z]", "Sensor position",
          {}, "origin, or the densest part of the cloud", "--sensor", "X,Y,Z"}, c.sensor);
  visit(S{"ground.sensor_height", "m", "Height of the sensor (the origin with plane) above the ground",
          {}, "estimated", "--sensor-height", "M"}, c.sensor_height);
  visit(S{"ground.distance", "m", "Height up to which points are ground",
          {0, kFinite, false}, "0.2; 0.15 with zones", "--ground-distance", "M"},
        c.distance);
  visit(S{"ground.max_slope_degrees", "degrees", "Maximum slope of the ground",
          {0, 89}, "20; 15 with plane", "--ground-slope", "DEG"}, c.max_slope_degrees);
  visit(S{"ground.cell_size", "m", "Side of the cells of slope",
          {0.01, 1000}, "1", "--ground-cell", "M"}, c.cell_size);
}

template <typename Cluster, typename Visit>
void visit_cluster(Cluster& c, Visit&& visit) {
  using S = Setting;
  visit(S{"cluster.tolerance", "m; 0: all points are one object",
          "Points closer than this are one object; 0: all",
          {0, 1e6, true, true}, {}, "--cluster", "TOL[:PER_METRE]", {"TOL", false}}, c.tolerance);
  visit(S{"cluster.min_size", "points", "Drop objects of fewer points",
          {0, kNoLimit}, "10; without clusters 0", "--min-size", "N"}, c.min_size);
  visit(S{"cluster.max_size", "points", "Drop objects of more points",
          {1, kNoLimit}, {}, "--max-size", "N"}, c.max_size);
  visit(S{"cluster.min_points", "points; 1: no noise",
          "Drop noise: points that are not nearer than the tolerance to a core point",
          {1, kNoLimit}, {}, "--min-points", "N"}, c.min_points);
  visit(S{"cluster.tolerance_per_metre", "m per m",
          "The tolerance grows by this with the distance from the origin",
          {0, 1e6, true, true}, {}, "--cluster", {}, {"PER_METRE", true, true}},
        c.tolerance_per_metre);
  visit(S{"cluster.oversized", "drop, keep, split",
          "Handling of objects above the maximum size",
          {}, {}, "--oversized", "RULE"}, c.oversized);
  visit(S{"cluster.refine", "auto, off, neck, tracks",
          "Cut people out of clusters; tracks (bv_stream): join parts of vehicles, too",
          {}, "tracks with tracking, otherwise off", "--refine", "HOW"}, c.refine);
  visit(S{"cluster.min_extent", "m, [along, across, up]",
          "Drop objects whose upright box is shorter, narrower or lower",
          {}, "no limit", "--min-extent", "L,W,H"}, c.min_extent);
  visit(S{"cluster.max_extent", "m, [along, across, up]",
          "Drop objects whose upright box is longer, wider or higher",
          {0, kNoLimit, false}, "no limit", "--max-extent", "L,W,H"}, c.max_extent);
  visit(S{"cluster.class_field", "name of a field",
          "Integer field with the classes of points; an object has one class",
          {}, "none", "--class", "FIELD"}, c.class_field);
  visit(S{"cluster.classes",
          "[{value: 4, drop: false, tolerance: 0.5 m, min_size: 9, max_size: 99, volumes: [obb], name: car}]",
          "Classes that differ from the others"}, c.classes);
}

template <typename Track, typename Visit>
void visit_track(Track& c, Visit&& visit) {
  using S = Setting;
  visit(S{"track.enabled", "", "Give objects ids that last from frame to frame",
          {}, {}, "--track"}, c.enabled);
  visit(S{"track.gate", "m", "Largest distance of an object from its predicted position",
          {0, 100, false}}, c.gate);
  visit(S{"track.birth", "frames", "Detections after which an object gets its id", {1, 1000}}, c.birth);
  visit(S{"track.death", "frames", "Frames without a detection after which a track is deleted",
          {1, 1000}}, c.death);
  visit(S{"track.smooth", "", "Smooth the yaw of tracked upright boxes; they still hold all points",
          {}, {}, "--smooth"}, c.smooth);
  visit(S{"track.grow", "", "Give tracked upright boxes the largest length and width seen",
          {}, {}, "--grow"}, c.grow);
  visit(S{"track.vehicles", "", "With grow: boxes of what may be a side of a vehicle are at least 3.9 m x 1.6 m"},
        c.vehicles);
}

template <typename Runner, typename Visit>
void visit_runner(Runner& c, Visit&& visit) {
  using S = Setting;
  visit(S{"runner.queue", "frames", "Frames that may wait", {1, 100'000}, {}, "--queue", "N"}, c.queue);
  visit(S{"runner.policy", "auto, drop_oldest, drop_newest, block",
          "When the queue is full",
          {}, {}, "--policy", "NAME"}, c.policy);
  visit(S{"runner.max_age_ms", "ms; 0: any age", "Drop frames that have waited longer"}, c.max_age_ms);
  visit(S{"runner.watchdog_s", "s; 0: none", "Warn if no frame comes for this time"}, c.watchdog_s);
}

template <typename Rig, typename Visit>
void visit_rig(Rig& c, Visit&& visit) {
  using S = Setting;
  visit(S{"rig.frame", "frame id", "Merge the clouds of all sensors in this frame",
          {}, "one sensor, in its own frame", "--target-frame", "NAME"}, c.frame);
  visit(S{"rig.fixed_frame", "frame id", "Frame that does not move, such as odom: /tf has the poses of the robot",
          {}, "no poses from /tf", "--fixed-frame", "NAME"}, c.fixed_frame);
  visit(S{"rig.odometry", "topic", "Topic of nav_msgs/Odometry with the poses of the robot, instead of /tf",
          {}, "/tf, or the recording's first such topic without /tf", "--odometry", "TOPIC"}, c.odometry);
  visit(S{"rig.sync_ms", "ms", "Clouds of one frame differ by less than this",
          {0, 1000, false}, {}, "--sync", "MS"}, c.sync_ms);
  visit(S{"rig.urdf", "file", "URDF of the robot: its fixed joints are transforms",
          {}, "none", "--urdf", "FILE"}, c.urdf);
  visit(S{"rig.self_filter", "m", "Drop points inside the collision shapes of the URDF, inflated by this",
          {}, "off", "--self-filter", "M"}, c.self_filter);
  visit(S{"rig.sensors", "[{topic: /points, frame: lidar, pose: [x, y, z, roll, pitch, yaw]}]",
          "Sensors; pose in m and radians, or from transforms"}, c.sensors);
}

/// Calls visit(setting, value) for each setting of a pipeline. `value` refers to the field of `c`, const if
/// `c` is const. The type of `value` is one of:
/// - bool, double, std::size_t, std::string (the instruction set), Eigen::Vector3d (a direction) or an enum;
/// - std::optional of a double, a std::size_t, a point, an UprightSize or a FieldName;
/// - std::vector of a std::string (methods), a RegionConfig or a ClassConfig.
template <typename Pipeline, typename Visit>
void visit_pipeline(Pipeline& c, Visit&& visit) {
  using S = Setting;
  visit_filter(c.filter, visit);
  visit(S{"deskew", "off, on, auto",
          "Move points by their own times to the stamp of the sweep; auto: if possible",
          {}, {}, "--deskew", "HOW"}, c.deskew);
  visit_ground(c.ground, visit);
  visit_cluster(c.cluster, visit);
  visit(S{"volumes", "methods", "Methods with commas, or all",
          {}, "obb-lshape; without clusters aabb,sphere,obb", "--volume", "LIST"}, c.volumes);
  visit(S{"growth", "sequential, stationary, deferred",
          "Sphere growth (Ritter, EPOS)",
          {}, {}, "--growth", "POLICY"}, c.growth);
  visit(S{"concave_length", "m", "Outlines of prisms follow bays that are wider than this",
          {0, kFinite, false}, "convex outlines", "--concave", "M"}, c.concave_length);
  visit_track(c.track, visit);
  visit(S{"threads", "0: all processors", "Threads, 0 for all processors",
          {0, 1024}, {}, "--threads", "N"}, c.threads);
  visit(S{"isa", "", "Instruction set, of those that --version lists", {}, {}, "--isa", "NAME"}, c.isa);
}
// clang-format on

/// Same as visit_pipeline(), for all settings of a stream: those of its pipeline, its runner and its rig,
/// where `value` may also be a std::string of any text or a std::vector of a RigSensor.
template <typename Stream, typename Visit>
void visit_stream(Stream& c, Visit&& visit) {
  visit_pipeline(c.pipeline, visit);
  visit_runner(c.runner, visit);
  visit_rig(c.rig, visit);
}

/// Returns the range of the setting of a pipeline with this key. Throws std::logic_error if there is none.
NumberRange range_of(std::string_view key);

/// Return a value as text. Numbers have as few digits as read_text() needs to return the same number.
/// A missing value is "null", and a missing limit is "unlimited".
std::string to_text(bool value);
std::string to_text(double value);
std::string to_text(std::size_t value);
std::string to_text(const Eigen::Vector3d& direction);
std::string to_text(const std::string& name);
/// Returns a text of any characters as YAML quotes it.
std::string yaml_quoted(const std::string& name);
std::string to_text(const std::vector<std::string>& names);  ///< Joined by ", ".
/// Return rows in the syntax of the setting's unit, without [] and without unset fields.
std::string to_text(const std::vector<RegionConfig>& regions);
std::string to_text(const std::vector<ClassConfig>& classes);
std::string to_text(const std::vector<RigSensor>& sensors);
std::string to_text(GroundMethod method);
std::string to_text(Oversized rule);
std::string to_text(Refine refine);
std::string to_text(Deskew deskew);
std::string to_text(const FieldName& field);
std::string to_text(const UprightSize& size);  ///< An infinite side is "unlimited".
std::string to_text(SphereGrowth growth);
std::string to_text(QueuePolicy policy);
std::string to_text(const std::optional<Eigen::Vector3d>& point);
template <typename T>
std::string to_text(const std::optional<T>& value) {
  return value ? to_text(*value) : "null";
}

/// Parse a value in the format of to_text(). Throw std::invalid_argument for any other text, such as "'far'
/// is not a number". Ranges are checked by problem_of(), not here.
void read_text(std::string_view text, bool& value);
void read_text(std::string_view text, double& value);
void read_text(std::string_view text, std::size_t& value);
void read_text(std::string_view text, Eigen::Vector3d& direction);
void read_text(std::string_view text, std::string& name);
void read_text(std::string_view text,
               std::vector<std::string>& names);                            ///< `all` means methods_of_all().
void read_text(std::string_view text, std::vector<RegionConfig>& regions);  ///< One region with this file.
void read_text(std::string_view text, std::vector<ClassConfig>& classes);   ///< One class with this value.
void read_text(std::string_view text, std::vector<RigSensor>& sensors);     ///< One sensor with this topic.
void read_text(std::string_view text, GroundMethod& method);
void read_text(std::string_view text, Oversized& rule);
void read_text(std::string_view text, Refine& refine);
void read_text(std::string_view text, Deskew& deskew);
void read_text(std::string_view text, FieldName& field);
void read_text(std::string_view text, UprightSize& size);
void read_text(std::string_view text, SphereGrowth& growth);
void read_text(std::string_view text, QueuePolicy& policy);
void read_text(std::string_view text, std::optional<Eigen::Vector3d>& point);
template <typename T>
void read_text(std::string_view text, std::optional<T>& value) {
  value.reset();
  if (text != "null") read_text(text, value.emplace());
}

/// Return why a value is not allowed, such as "-1 is not at least 0", or an empty text if it is allowed.
std::string problem_of(const Setting& setting, double value);
std::string problem_of(const Setting& setting, std::size_t value);
std::string problem_of(const Setting& setting, const Eigen::Vector3d& direction);
/// Texts other than instruction sets are any text.
std::string problem_of(const Setting& setting, const std::string& text);
std::string problem_of(const Setting& setting, const std::vector<std::string>& methods);
std::string problem_of(const Setting& setting, const std::optional<Eigen::Vector3d>& point);
std::string problem_of(const Setting& setting, const FieldName& field);
std::string problem_of(const Setting& setting, const UprightSize& size);
std::string problem_of(const Setting& setting, const std::vector<RegionConfig>& regions);
std::string problem_of(const Setting& setting, const std::vector<ClassConfig>& classes);
std::string problem_of(const Setting& setting, const std::vector<RigSensor>& sensors);
template <typename Choice>
std::string problem_of(const Setting& /*setting*/, Choice /*any*/) {
  return {};
}
template <typename T>
std::string problem_of(const Setting& setting, const std::optional<T>& value) {
  return value ? problem_of(setting, *value) : std::string();
}

}  // namespace detail
}  // namespace pcl_bv
