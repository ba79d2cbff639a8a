// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Joins cells with linked points. The results are connected components.
#pragma once

#include <vector>

#include "any_link.h"
#include "cells.h"
#include "pcl_bv/parallel/execution.h"
#include "union_find.h"

namespace pcl_bv::detail {

/// Buffers that calls reuse.
template <typename T>
struct JoinScratch {
  std::vector<LinkScratch<T>> links;  ///< One entry per chunk of blocks.
  /// For each cell, whether two of its points are possibly not linked. Empty if nodes are cells.
  std::vector<std::uint8_t> non_solid;
};

/// Sets `sets` to the connected components of the nodes. If nodes are cells, sets Block::united of each
/// block.
///
/// The coordinates of a pair with d2 < r2 may differ by two cells along each axis, so the 124 cells around a
/// cell have to be tested. If nodes are cells, the caller guarantees that all points of a cell are linked. If
/// nodes are points, join_cells() tests each cell for this property. Cells without it are joined point by
/// point. Rounding causes such cells if squares are near the smallest float, or for doubles 10^8 cells from
/// the origin.
template <typename T, typename Key>
void join_cells(const CellGrid& grid, T r2, const ParallelPolicy& policy, const std::vector<Key>& keys,
                Cells<T>& cells, UnionFind& sets, JoinScratch<T>& scratch);

}  // namespace pcl_bv::detail
