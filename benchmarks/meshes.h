// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scanned and modelled meshes of other packages, beside the generated stand-ins for those of the paper.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_bv::bench {

struct Mesh {
  std::string name;
  std::size_t triangles = 0;
  std::vector<float> xyz;  ///< Of the vertices.

  std::size_t points() const { return xyz.size() / 3; }
  std::vector<float> first_points(std::size_t count) const;
};

/// Those that are there, by number of vertices: the Stanford bunny of glmark2-data, and some of CGAL's
/// (package libcgal-demo), unpacked to the folder that PCL_BV_MESHES names.
const std::vector<Mesh>& meshes();

/// Null if it is not there.
const Mesh* find_mesh(const std::string& name);

}  // namespace pcl_bv::bench
