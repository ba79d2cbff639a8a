// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Many queries to a PointTree in one call, in parallel. The results are those of the single queries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/trees/point_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Lists of neighbours, concatenated. Query point i has neighbors[j] for first[i] <= j < first[i + 1].
struct NeighborLists {
  /// The neighbours of all query points.
  std::vector<Neighbor> neighbors;
  /// Start of each query point's list, then the total: one entry more than query points.
  std::vector<std::size_t> first;
};

/// Sets found[i] to PointTree::nearest() of the i-th query point, or to index -1 and distance infinity if
/// there is none. Resizes `found` to the number of query points. Throws std::invalid_argument unless the
/// query points are in memory, and if max_distance is negative or NaN.
void nearest(const PointTree& tree, const PointView& query_points, std::vector<Neighbor>& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// Lists the k nearest points of each query point, ascending. Throws likewise.
void nearest(const PointTree& tree, const PointView& query_points, std::size_t k, NeighborLists& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// Lists all points within `distance` of each query point, in ascending order of Neighbor. Throws likewise.
void near(const PointTree& tree, const PointView& query_points, double distance, NeighborLists& found,
          const Execution& execution = {});

/// Sets inside[i] to 1 if PointTree::any_inside() holds for volume i, else to 0. Resizes `inside` to the
/// number of volumes.
void any_inside(const PointTree& tree, const std::vector<Sphere>& spheres, std::vector<std::uint8_t>& inside,
                const Execution& execution = {});
void any_inside(const PointTree& tree, const std::vector<AnyVolume>& volumes,
                std::vector<std::uint8_t>& inside, const Execution& execution = {});

}  // namespace pcl_bv
