// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Joins cells with linked points to connected components.
#pragma once

#include <vector>

#include "any_link.h"
#include "cells.h"
#include "pcl_bv/parallel/policy.h"
#include "union_find.h"

namespace pcl_bv {

/// Buffers that calls reuse.
template <typename T>
struct JoinScratch {
  std::vector<LinkScratch<T>> links;  ///< One for each chunk.
  /// For each cell, whether some of its points may not be linked; empty if there is no such cell.
  std::vector<std::uint8_t> non_solid;
};

/// Sets `sets` to the connected components of the nodes, and Block::united of each block.
///
/// A pair d2 < r2 may span two cells along each axis, so all 124 neighbours of a cell matter. If nodes are
/// cells, all points of a cell must be linked. If nodes are points, each cell is tested. Cells in which
/// rounding may separate two points (squares near the smallest float, doubles 10^8 cells out) are joined
/// point by point.
template <typename T, typename Key>
void join_cells(const CellGrid& grid, T r2, const ParallelPolicy& policy, const std::vector<Key>& keys,
                Cells<T>& cells, UnionFind& sets, JoinScratch<T>& scratch);

}  // namespace pcl_bv
