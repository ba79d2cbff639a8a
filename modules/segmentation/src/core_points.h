// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// DBSCAN's core and border points, on the cells that Euclidean clusters are found with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cells.h"
#include "pcl_bv/parallel/policy.h"

namespace pcl_bv {

/// Memory that calls share: 9 bytes a point and 16 a block.
template <typename T>
struct CoreScratch {
  std::vector<std::uint8_t> core;         ///< Of each place in Cells::points, whether it holds a core point.
  std::vector<std::uint64_t> core_cells;  ///< Of each block, its cells with core points,
  std::vector<std::uint64_t> sparse_cells;  ///< and those with others.
  std::vector<std::uint32_t> number;        ///< Of each place, the point's number in the array made to cells.
  std::vector<std::uint32_t> label;         ///< Of each place: a border point's core point, then the node.
  std::vector<Box<T>> groups;               ///< Of `group_size` places each.
};

/// Places that have a box in common: cells of very many points are asked group by group.
inline constexpr std::uint32_t group_size = 32;

/// What is core and what is border. A point is core if at least min_points (>= 2) points, itself included,
/// have squared_distance() < r2; a border point goes to the core point that is nearest to it, of several
/// equally near ones to that of the smallest number.
///
/// `cells` were made by_point. `solid`: all pairs of points of a cell are linked; then a cell of min_points
/// points is core without a test.
template <typename T, typename Key>
void find_core(const CellGrid& grid, T r2, std::size_t min_points, bool solid, const ParallelPolicy& policy,
               const std::vector<Key>& keys, const Cells<T>& cells, CoreScratch<T>& scratch);

/// Leaves only core points in the cells, as nodes that are points or cells by cells.by_point, and sets
/// cells.node to the node of each point's cluster; noise gets the number after the last node, which is
/// returned.
template <typename T>
std::uint32_t keep_core(Cells<T>& cells, CoreScratch<T>& scratch);

}  // namespace pcl_bv
