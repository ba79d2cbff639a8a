// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace [[gnu::visibility("default")]] pcl_bv {

/// A closed polygon mesh in the frame and unit of the volume that it describes.
///
/// Faces are convex and counter-clockwise seen from outside. An empty volume has an empty mesh. A flat volume
/// has faces of area 0, or two faces that coincide.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<std::int32_t>> faces;  ///< Indices into `vertices`, in order around each face.
};

}  // namespace pcl_bv
