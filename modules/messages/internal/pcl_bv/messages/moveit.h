// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Messages of moveit_msgs and shape_msgs. types.h describes each_field(). Fields that are never filled have
// types with the same bytes as the empty value, so that the 12 types inside them need no structs.
#pragma once

#include "pcl_bv/messages/polygon.h"
#include "pcl_bv/messages/results.h"

namespace [[gnu::visibility("default")]] pcl_bv {
namespace msg {

/// A list of any type that is always empty. Lists with elements cannot be read.
struct EmptyList {
  template <class Self, class Visit>
  static void each_field(Self&, Visit& visit) {
    std::uint32_t size = 0;
    visit(size);
  }
};

/// shape_msgs/msg/SolidPrimitive.
struct ShapePrimitive {
  enum : std::uint8_t { BOX = 1, SPHERE, CYLINDER };
  std::uint8_t type = BOX;
  /// Metres. BOX: lengths along x, y and z; SPHERE: radius; CYLINDER: height along z, radius.
  std::vector<double> dimensions;
  Polygon polygon;  ///< Always empty: only for prisms. ROS 1 does not have this field.
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.type, m.dimensions);
    if constexpr (!Visit::ros1) visit(m.polygon);
  }
};

/// shape_msgs/msg/MeshTriangle.
struct MeshTriangle {
  std::array<std::uint32_t, 3> vertex_indices{};
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.vertex_indices);
  }
};

/// shape_msgs/msg/Mesh.
struct TriangleMesh {
  std::vector<MeshTriangle> triangles;
  std::vector<Point> vertices;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.triangles, m.vertices);
  }
};

/// moveit_msgs/msg/CollisionObject.
struct CollisionObject {
  static constexpr const char* ros_type = "moveit_msgs/msg/CollisionObject";
  enum : std::uint8_t { ADD = 0, REMOVE, APPEND, MOVE };
  Header header;
  Pose pose;  ///< In the header's frame. The poses of the shapes are relative to it.
  std::string id;
  KeyValue type;  ///< object_recognition_msgs/msg/ObjectType: key, db.
  std::vector<ShapePrimitive> primitives;
  std::vector<Pose> primitive_poses;
  std::vector<TriangleMesh> meshes;
  std::vector<Pose> mesh_poses;
  EmptyList planes, plane_poses, subframe_names, subframe_poses;
  std::uint8_t operation = ADD;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.pose, m.id, m.type, m.primitives, m.primitive_poses, m.meshes, m.mesh_poses, m.planes,
          m.plane_poses, m.subframe_names, m.subframe_poses, m.operation);
  }
};

/// moveit_msgs/msg/RobotState without joints.
struct RobotState {
  Header joint_header;
  EmptyList joint_names, positions, velocities, efforts;  ///< sensor_msgs/msg/JointState.
  Header multi_dof_header;
  EmptyList multi_dof_names, transforms, twists, wrenches;  ///< sensor_msgs/msg/MultiDOFJointState.
  EmptyList attached_collision_objects;
  bool is_diff = false;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.joint_header, m.joint_names, m.positions, m.velocities, m.efforts, m.multi_dof_header,
          m.multi_dof_names, m.transforms, m.twists, m.wrenches, m.attached_collision_objects, m.is_diff);
  }
};

/// octomap_msgs/msg/OctomapWithPose without a map.
struct OctomapWithPose {
  Header header;
  Pose origin;
  Header octomap_header;
  bool binary = false;
  std::string id;
  double resolution = 0;
  EmptyList data;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.header, m.origin, m.octomap_header, m.binary, m.id, m.resolution, m.data);
  }
};

/// moveit_msgs/msg/ObjectColor.
struct ObjectColor {
  std::string id;
  ColorRGBA color;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.id, m.color);
  }
};

/// moveit_msgs/msg/PlanningScene.
struct PlanningScene {
  static constexpr const char* ros_type = "moveit_msgs/msg/PlanningScene";
  std::string name;
  RobotState robot_state;
  std::string robot_model_name;
  EmptyList fixed_frame_transforms;
  EmptyList entry_names, entry_values, default_entry_names, default_entry_values;  ///< Allowed collisions.
  EmptyList link_padding, link_scale;
  std::vector<ObjectColor> object_colors;
  std::vector<CollisionObject> collision_objects;  ///< This field and the next: PlanningSceneWorld.
  OctomapWithPose octomap;
  bool is_diff = false;
  template <class Self, class Visit>
  static void each_field(Self& m, Visit& visit) {
    visit(m.name, m.robot_state, m.robot_model_name, m.fixed_frame_transforms, m.entry_names, m.entry_values,
          m.default_entry_names, m.default_entry_values, m.link_padding, m.link_scale, m.object_colors,
          m.collision_objects, m.octomap, m.is_diff);
  }
};

}  // namespace msg
}  // namespace pcl_bv
