// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters above the greatest size, cut into smaller ones.
#pragma once

#include <functional>

#include "pcl_bv/segmentation/euclidean_clusters.h"

namespace pcl_bv {

/// Memory that calls share.
struct SplitScratch {
  Clusters current, next;
  std::vector<std::size_t> order;
};

/// Clusters the points of a view with so large a tolerance, and appends the clusters, of whatever greatest
/// size.
using ClusterPoints = std::function<void(const PointView&, const ClusterSettings&, Clusters&)>;

/// Replaces each cluster of `clusters`, which are found with `settings` but for its max_size, that is above
/// max_size by the clusters of its points with half the tolerance, up to three times; what is still too large
/// is dropped.
void split_oversized(const PointView& points, const ClusterSettings& settings, const ClusterPoints& cluster,
                     Clusters& clusters, SplitScratch& scratch);

}  // namespace pcl_bv
