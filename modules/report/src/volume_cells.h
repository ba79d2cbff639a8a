// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// All volumes of a report as one list of vertices and cells, from which all mesh formats are written.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pcl_bv/report/report.h"

namespace pcl_bv::detail {

/// The volume that a cell belongs to.
struct CellOwner {
  std::size_t cluster = 0;  ///< Id of the cluster.
  std::size_t method = 0;   ///< Index in VolumeCells::methods.
  std::size_t points = 0;   ///< Number of points of the cluster.
  double volume = 0;
  std::size_t entry = 0;  ///< Index of the cluster in the argument of volume_cells().
};

struct Cell {
  std::vector<std::int32_t> vertices;
  std::size_t owner = 0;  ///< Index in VolumeCells::owners.
};

struct VolumeCells {
  std::vector<std::string> methods;  ///< In order of appearance.
  std::vector<CellOwner> owners;     ///< One for each volume that is not empty.
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::size_t> vertex_owners;     ///< Index in `owners` of each vertex.
  std::vector<Cell> points, lines, polygons;  ///< Cells of one, of two, and of three or more vertices.
};

/// Returns the cells of all volumes. Throws std::length_error for more than 2147483647 vertices.
VolumeCells volume_cells(const std::vector<ClusterEntry>& clusters);

/// Returns the .ply file of volumes_ply(). Vertices have the colour of their cluster if `colour_by_cluster`,
/// else of their method.
std::string cells_ply(const VolumeCells& cells, bool colour_by_cluster);

}  // namespace pcl_bv::detail
