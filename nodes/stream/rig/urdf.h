// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The description of a robot in URDF (wiki.ros.org/urdf/XML).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pcl_bv/fitting/methods.h"
#include "transforms.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// A joint between two links. If it is movable, `pose` is the pose at its position 0.
struct UrdfJoint {
  std::string name, parent, child;
  Pose pose = Pose::Identity();
  bool movable = false;
};

/// A collision shape of a link, in the frame of the link.
struct UrdfShape {
  std::string link;
  AnyVolume volume;
};

/// Joints and collision shapes of a robot.
struct Urdf {
  std::vector<UrdfJoint> joints;
  std::vector<UrdfShape> shapes;
  std::vector<std::string> warnings;  ///< Shapes that could not be read, one line each.

  /// Adds the fixed joints, as final transforms.
  void add_joints(Transforms& to) const;

  /// Returns the collision shapes in the frame of the link `frame`, with all joints at their position 0, and
  /// a warning for each joint that moves. Shapes of links that are not connected with `frame` are left out
  /// with a warning. Throws IoError if no joint and no shape names the frame.
  std::vector<AnyVolume> volumes_in(const std::string& frame, std::vector<std::string>& warnings) const;
};

enum class UrdfContent { joints, joints_and_shapes };

/// Reads a URDF file. Shapes are read only on request, because a mesh can take seconds. Boxes, spheres and
/// cylinders are read as such, meshes (.stl, .obj) as their convex hulls. `package://` paths are found in the
/// folders above the file, in ROS_PACKAGE_PATH and in the share folders of AMENT_PREFIX_PATH. Meshes that
/// cannot be read and other geometries give a warning. Throws IoError if the file cannot be read, has more
/// than 16 MiB, is not XML or not a robot, or has an invalid number.
Urdf read_urdf(const std::filesystem::path& file, UrdfContent content = UrdfContent::joints_and_shapes);

/// Returns the vertices of a mesh (.stl, .obj), at most 10 million. Throws IoError if the file cannot be read
/// or has another format.
std::vector<Eigen::Vector3d> read_mesh_vertices(const std::filesystem::path& file);

}  // namespace detail
}  // namespace pcl_bv
