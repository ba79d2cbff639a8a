// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts the roots of points to clusters in the order of the result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv::detail {

/// Value for the root of noise if no point can be noise.
constexpr std::uint32_t no_root = std::numeric_limits<std::uint32_t>::max();

/// A connected component, with its root, its number of points and the position of its first point.
struct Component {
  std::uint32_t root, size, first_point;
};

/// Buffers that calls reuse. `size` and `next` are indexed by root.
struct Collector {
  std::vector<std::uint32_t> size;
  std::vector<std::uint32_t> next;  ///< Position in Clusters::indices for the next point.
  std::vector<Component> selected;
};

/// Appends the components of allowed sizes to `clusters`, the largest first. Adds the numbers of points of
/// the other components to the counts in `clusters`. The point with the index numbers[i] is in the component
/// roots[node[i]].
void write_clusters(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node,
                    std::uint32_t noise, const std::vector<std::int32_t>& numbers,
                    const ClusterOptions& options, Collector& collector, Clusters& clusters);

/// Appends cluster number `cluster` of `from` to `to`.
void append(const Clusters& from, std::size_t cluster, Clusters& to);

/// Replaces the clusters of `to` by those of `from`. The largest cluster is first; clusters of equal size are
/// ordered by their smallest point index. Drops clusters with more than max_size points and adds their points
/// to to.large_points. Sets `order` to the positions in `from`, sorted in this way, including dropped
/// clusters.
void write_sorted(const Clusters& from, std::size_t max_size, std::vector<std::size_t>& order, Clusters& to);

}  // namespace pcl_bv::detail
