// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds that trees are built over, and what these are asked.
#pragma once

#include <string>
#include <vector>

#include "tree_peers.h"

namespace pcl_bv::bench {

struct TreeInput {
  TreeCloud::Ptr cloud;
  std::vector<pcl::PointXYZ> near;     ///< Places about the points: of sweeps all points of the next one.
  std::vector<pcl::PointXYZ> centres;  ///< Random, in the cloud's box.
  float side = 0;                      ///< Of that box, the longest.
  float radius = 0;  ///< To search in: 0.5 m of sweeps, elsewhere so that some ten points are near.
};

/// A scene of clouds.h, or "sweep": the first of $PCL_BV_DATA/lidar_sequence. Sweeps come without the beams
/// that met nothing: kd-trees take seconds over their copies of (0, 0, 0). The last one is kept.
const TreeInput& tree_input(const std::string& scene, std::size_t points);

}  // namespace pcl_bv::bench
