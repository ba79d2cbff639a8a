// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Splits clusters above the largest size.
#pragma once

#include <functional>

#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv::detail {

/// Buffers that calls reuse.
struct SplitScratch {
  Clusters current, next;
  std::vector<std::size_t> order;
};

/// Clusters the points of a view with the given options and appends the clusters of at least min_size points.
/// max_size is ignored.
using ClusterPoints = std::function<void(const PointView&, const ClusterOptions&, Clusters&)>;

/// Replaces each cluster above max_size by the clusters of its points with half the tolerance, up to three
/// times. Clusters that are then still too large are dropped. `clusters` must be found with `options`, but
/// without a limit of the size.
void split_oversized(const PointView& points, const ClusterOptions& options, const ClusterPoints& cluster,
                     Clusters& clusters, SplitScratch& scratch);

}  // namespace pcl_bv::detail
