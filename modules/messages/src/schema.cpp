// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/messages/schema.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pcl_bv {
namespace {

// What ROS 1 (Noetic) publishes, where more differs than the names of times and default values.
constexpr std::pair<std::string_view, std::string_view> kRos1Definitions[]{
    {"std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id\n"},
    {"shape_msgs/SolidPrimitive",
     "uint8 BOX=1\nuint8 SPHERE=2\nuint8 CYLINDER=3\nuint8 CONE=4\nuint8 type\nfloat64[] dimensions\n"
     "uint8 BOX_X=0\nuint8 BOX_Y=1\nuint8 BOX_Z=2\nuint8 SPHERE_RADIUS=0\nuint8 CYLINDER_HEIGHT=0\n"
     "uint8 CYLINDER_RADIUS=1\nuint8 CONE_HEIGHT=0\nuint8 CONE_RADIUS=1\n"},
    {"vision_msgs/ObjectHypothesisWithPose",
     "int64 id\nfloat64 score\ngeometry_msgs/PoseWithCovariance pose\n"},
    {"vision_msgs/Detection3D",
     "std_msgs/Header header\nvision_msgs/ObjectHypothesisWithPose[] results\n"
     "vision_msgs/BoundingBox3D bbox\nsensor_msgs/PointCloud2 source_cloud\n"},
};

// The MD5 sums of ROS 1's definitions (genmsg.compute_md5_text). Tests compare them with genmsg's.
constexpr std::pair<std::string_view, const char*> kRos1Sums[]{
    {"geometry_msgs/PolygonStamped", "c6be8f7dc3bee7fe9e8d296070f53340"},
    {"moveit_msgs/CollisionObject", "dbba710596087da521c07564160dfccb"},
    {"moveit_msgs/PlanningScene", "acfc50bcfd6c7b978066bfa7c786002c"},
    {"vision_msgs/BoundingBox3DArray", "9e1a3932308592aa1b20232d818486db"},
    {"vision_msgs/Detection3DArray", "05c51d9aea1fb4cfdc8effb94f197b6f"},
};

template <class Table>
auto find_in(const Table& table, std::string_view name) {
  return std::find_if(std::begin(table), std::end(table),
                      [&](const auto& entry) { return entry.first == name; });
}

// Returns "std_msgs/Header" of "std_msgs/msg/Header".
std::string without_msg(std::string_view type) {
  constexpr std::string_view middle = "/msg/";
  std::string name(type);
  if (const std::size_t at = name.find(middle); at != std::string::npos) name.replace(at, middle.size(), "/");
  return name;
}

// Calls on_line(type, rest) for each line. `rest` begins with a space.
template <class OnLine>
void each_line(std::string_view text, const OnLine& on_line) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));  // the last line may end without '\n'
    const std::size_t space = line.find(' ');
    on_line(line.substr(0, space), line.substr(space));
  }
}

std::string ros2_definition(std::string_view name) {
  return std::string(definition_of(name));
}

std::string ros1_definition(std::string_view name) {
  if (const auto* const own = find_in(kRos1Definitions, name); own != std::end(kRos1Definitions))
    return std::string(own->second);
  std::string text;
  each_line(definition_of(name), [&](std::string_view type, std::string_view rest) {
    if (type == "builtin_interfaces/Time") type = "time";
    if (type == "builtin_interfaces/Duration") type = "duration";
    const std::string_view field = rest.substr(0, rest.find(' ', 1));  // without a default value
    text.append(type).append(field).append("\n");
  });
  return text;
}

// Appends the types that a definition uses, directly or indirectly. Each type is appended once.
void collect(const std::string& name, std::string (*definition)(std::string_view),
             std::vector<std::string>& names) {
  each_line(definition(name), [&](std::string_view field_type, std::string_view) {
    const std::string type(field_type.substr(0, field_type.find('[')));
    if (type.find('/') == std::string::npos || std::find(names.begin(), names.end(), type) != names.end())
      return;
    names.push_back(type);
    collect(type, definition, names);
  });
}

std::string with_used_types(const std::string& name, std::string (*definition)(std::string_view)) {
  std::vector<std::string> others;
  collect(name, definition, others);
  std::string text = definition(name);
  for (const std::string& other : others)
    text.append(80, '=').append("\nMSG: ").append(other).append("\n").append(definition(other));
  return text;
}

}  // namespace

std::string schema_of(std::string_view type) {
  return with_used_types(without_msg(type), ros2_definition);
}

Ros1Type ros1_type_of(std::string_view type) {
  const std::string name = without_msg(type);
  const auto* const sum = find_in(kRos1Sums, name);
  if (sum == std::end(kRos1Sums)) throw std::invalid_argument("no message type of ROS 1: '" + name + "'");
  return {name, sum->second, with_used_types(name, ros1_definition)};
}

}  // namespace pcl_bv
