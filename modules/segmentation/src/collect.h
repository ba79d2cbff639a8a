// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// From roots of points to clusters in the order of the result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "pcl_bv/segmentation/euclidean_clusters.h"

namespace pcl_bv {

/// The root of noise where every valid point is in a cluster.
constexpr std::uint32_t no_root = std::numeric_limits<std::uint32_t>::max();

struct Component {
  std::uint32_t root, size, first_point;
};

/// Memory that calls share, by root.
struct Collector {
  std::vector<std::uint32_t> size;
  std::vector<std::uint32_t> next;  ///< Where the next index goes.
  std::vector<Component> kept;
};

/// Appends the components of the allowed sizes to `clusters`, the largest first, and adds up the points of
/// the others. Point i of the cloud's `numbers` belongs to roots[node[i]].
void collect(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node,
             std::uint32_t noise, const std::vector<std::int32_t>& numbers, const ClusterSettings& settings,
             Collector& collector, Clusters& clusters);

/// Appends one of the clusters.
void append(const Clusters& from, std::size_t cluster, Clusters& to);

/// Replaces the lists of `to` by those of `from`, the largest first, then by the smallest point number;
/// clusters above max_size are dropped, and their points added to to.large_points. `order` has the places in
/// `from` of all.
void write_sorted(const Clusters& from, std::size_t max_size, std::vector<std::size_t>& order, Clusters& to);

}  // namespace pcl_bv
