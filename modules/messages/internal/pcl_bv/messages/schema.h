// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <string_view>

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns the definition of a type of the headers next to this one in the encoding "ros2msg" of recordings.
/// `type` is a name such as "std_msgs/msg/Header". The definition is the .msg text of the type, then the .msg
/// text of each type that it uses. A line of 80 '=' and a line "MSG: package/Type" come before the text of
/// each used type. Throws std::invalid_argument for unknown types.
std::string schema_of(std::string_view type);

/// A message type as ROS 1 announces it.
struct Ros1Type {
  std::string name;  ///< "moveit_msgs/CollisionObject".
  std::string md5;   ///< Sum of the definition as published for Noetic, by which ROS 1 identifies a type.
  std::string definition;  ///< As schema_of(), with ROS 1's types.
};

/// Returns the type of a message that ROS 1 topics carry. `type` is as for schema_of(). Throws
/// std::invalid_argument for types that ROS 1 does not have or that are not sent there.
Ros1Type ros1_type_of(std::string_view type);

/// Returns the .msg text of one type: definition_of("std_msgs/Header"). Throws as schema_of().
std::string_view definition_of(std::string_view name);

}  // namespace pcl_bv
