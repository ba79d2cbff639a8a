// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Joins the pieces of clusters that have points in several bricks.
#pragma once

#include <vector>

#include "brick_clusters.h"

namespace pcl_bv::detail {

/// Appends the clusters that consist of pieces and have an allowed size. Counts the points of the others.
void join_pieces(const BrickClusterer& clusterer, const ClusterOptions& options, ScalarType scalar,
                 SpillFile& file, std::vector<StoredCluster>& clusters, Counts& counts);

}  // namespace pcl_bv::detail
