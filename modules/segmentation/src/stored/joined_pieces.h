// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Joins the pieces of clusters that have points in several bricks.
#pragma once

#include <vector>

#include "brick_clusters.h"
#include "union_find.h"

namespace pcl_bv::detail {

/// Joins the sets of pieces that have a core point in common. Piece p of brick b is the set first_set[b] + p.
void join_pieces(const std::vector<SharedPoints>& bricks, const std::vector<std::uint32_t>& first_set,
                 const SpillFile& file, UnionFind& sets);

/// Returns the numbers 0 to roots.size() - 1, ordered by their roots.
std::vector<std::uint32_t> order_by_root(const std::vector<std::uint32_t>& roots);

/// Writes the points of several pieces in the order of their numbers. Frees the space of pieces in the
/// temporary file; shares do not change.
StoredCluster merge_pieces(const std::vector<Piece>& pieces, ScalarType scalar, SpillFile& file);

}  // namespace pcl_bv::detail
