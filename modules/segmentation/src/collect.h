// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Converts the roots of points to clusters in the order of the result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "pcl_bv/segmentation/euclidean_clusters.h"

namespace pcl_bv {

/// Stands for the root of noise if all valid points are in clusters.
constexpr std::uint32_t no_root = std::numeric_limits<std::uint32_t>::max();

/// A connected component: its root, its number of points and the position of its first point.
struct Component {
  std::uint32_t root, size, first_point;
};

/// Buffers that calls reuse, indexed by root.
struct Collector {
  std::vector<std::uint32_t> size;
  std::vector<std::uint32_t> next;  ///< Where the next point index goes.
  std::vector<Component> selected;
};

/// Appends the components of allowed sizes to `clusters`, the largest first, and adds the points of the
/// others to its counts. The point with the index numbers[i] is in the component roots[node[i]].
void write_clusters(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node,
                    std::uint32_t noise, const std::vector<std::int32_t>& numbers,
                    const ClusterSettings& settings, Collector& collector, Clusters& clusters);

/// Appends one cluster of `from`.
void append(const Clusters& from, std::size_t cluster, Clusters& to);

/// Replaces the lists of `to` by those of `from`: the largest first, then by the smallest point index.
/// Clusters above max_size are dropped and counted in to.large_points. Sets `order` to the positions in
/// `from`, sorted.
void write_sorted(const Clusters& from, std::size_t max_size, std::vector<std::size_t>& order, Clusters& to);

}  // namespace pcl_bv
