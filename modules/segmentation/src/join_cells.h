// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <vector>

#include "any_link.h"
#include "cells.h"
#include "pcl_bv/parallel/policy.h"
#include "union_find.h"

namespace pcl_bv {

/// Memory that calls share.
template <typename T>
struct JoinScratch {
  std::vector<LinkScratch<T>> links;  ///< Of each chunk.
  std::vector<std::uint8_t> loose;    ///< Of each cell, whether its points may be apart; empty if none may.
};

/// Sets `sets` to the connected components of the nodes. Marks united blocks.
///
/// A pair d2 < r2 may span two cells along each axis, so all 124 neighbours of a cell matter. Where nodes are
/// cells, all pairs of points in a cell must be linked. Where they are points, each cell is asked, and those
/// in which rounding may hold two points apart (squares near the smallest float, doubles 10^8 cells out) are
/// joined point by point.
template <typename T, typename Key>
void join_cells(const CellGrid& grid, T r2, const ParallelPolicy& policy, const std::vector<Key>& keys,
                Cells<T>& cells, UnionFind& sets, JoinScratch<T>& scratch);

}  // namespace pcl_bv
