// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the core points and border points of DBSCAN in the cells of the Euclidean clusters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cells.h"
#include "count_linked.h"
#include "pcl_bv/parallel/execution.h"
#include "point_boxes.h"

namespace pcl_bv::detail {

/// Buffers that calls reuse. They take about 23 (float) or 37 (double) bytes per point and 16 bytes per
/// block. A position is a position in Cells::points.
template <typename T>
struct CoreScratch {
  std::vector<std::uint8_t> core;                  ///< For each position, whether the point is core.
  std::vector<std::uint64_t> core_cells;           ///< For each block, bits of its cells with core points.
  std::vector<std::uint64_t> cells_with_non_core;  ///< For each block, bits of cells with non-core points.
  std::vector<std::uint32_t> number;  ///< For each position, the point's index in the input of make_cells().
  /// For each position of a border point, the position of its core point. For each position of a core point,
  /// its node, which remove_non_core() sets.
  std::vector<std::uint32_t> label;
  PointBoxes<T> boxes;                   ///< Of all points, then of the core points.
  std::vector<CellPoint<T>> large_cell;  ///< Copy of the points of one cell.
  PointColumns<T> columns;               ///< Of Cells::points.
};

/// Number of points up to which all points of the cells around are compared, instead of those of some boxes.
inline constexpr std::uint32_t few_points = 1024;

/// Finds the core points, and the core point of each border point. A point is a core point if at least
/// min_points (>= 2) points, itself included, have squared_distance() < r2 from it. A border point belongs to
/// its nearest core point. If several are equally near, it belongs to the one with the smallest index.
///
/// `cells` must be made with Cells::by_point = true. `solid` means that all points of a cell are linked. Then
/// the points of a cell with min_points or more points are core points without a test.
///
/// Reorders the points of large cells, so that boxes hold points near each other.
template <typename T, typename Key>
void find_core(const CellGrid& grid, T r2, std::size_t min_points, bool solid, const ParallelPolicy& policy,
               const std::vector<Key>& keys, Cells<T>& cells, CoreScratch<T>& scratch);

/// Removes all points but the core points from the cells. Nodes are then core points if cells.by_point, else
/// cells. Sets cells.node of every point to the node of its cluster. All noise has one extra node, numbered
/// after the others. Returns this node.
template <typename T>
std::uint32_t remove_non_core(Cells<T>& cells, CoreScratch<T>& scratch);

}  // namespace pcl_bv::detail
