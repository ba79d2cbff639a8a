// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Joins the pieces of clusters that have points in several bricks.
#pragma once

#include <vector>

#include "brick_clusters.h"

namespace pcl_bv::detail {

/// Appends the clusters that consist of pieces.
void join_pieces(const BrickClusterer& clusterer, ScalarType scalar, SpillFile& file,
                 std::vector<StoredCluster>& clusters);

/// Removes and counts clusters of sizes that are not allowed, and sorts the others.
void select_and_sort(const ClusterOptions& options, std::vector<StoredCluster>& clusters, Counts& counts);

}  // namespace pcl_bv::detail
