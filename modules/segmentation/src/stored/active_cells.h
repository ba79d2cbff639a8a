// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Finds where points of several shares are near each other.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "pcl_bv/segmentation/cluster_share.h"

namespace pcl_bv::detail {

enum class CellKind : std::uint8_t {
  passive,      ///< The cell and the 26 cells around it have points of one share only.
  near_active,  ///< Passive and adjacent to an active cell.
  active
};

/// Returns the cells of a share that have points of other shares in or around them. A cell is a cube of
/// `side` cells of the grid, a power of 2, and has the key of the first. Calls gather() kGatherCalls times.
std::unordered_set<std::uint64_t> cells_near_others(const std::vector<std::uint64_t>& cells, int side,
                                                    const GatherCells& gather);

/// Returns the cells with points that are active or near an active cell.
std::unordered_map<std::uint64_t, CellKind> find_active_cells(const std::vector<const ClusterShare*>& shares);

}  // namespace pcl_bv::detail
