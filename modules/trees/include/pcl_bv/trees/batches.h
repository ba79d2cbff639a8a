// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs many queries of a PointTree in parallel. The results are those of the single queries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/trees/point_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Lists of neighbours, concatenated. The neighbours of query point i are neighbors[first[i]] to
/// neighbors[first[i + 1] - 1].
struct NeighborLists {
  /// The neighbours of all query points.
  std::vector<Neighbor> neighbors;
  /// Start of each query point's list in `neighbors`, and at the end the size of `neighbors`.
  std::vector<std::size_t> first;
};

/// Resizes `found` to the number of query points. Sets found[i] to PointTree::nearest() of the i-th query
/// point, or to index -1 and distance infinity if there is none. Throws std::invalid_argument if the query
/// points are not in memory, or if max_distance is negative or NaN.
void nearest(const PointTree& tree, const PointView& query_points, std::vector<Neighbor>& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// Lists the k nearest points of each query point, in ascending order of Neighbor. Throws like nearest()
/// above.
void nearest(const PointTree& tree, const PointView& query_points, std::size_t k, NeighborLists& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// Lists all points within `distance` of each query point, in ascending order of Neighbor. Throws like
/// nearest().
void near(const PointTree& tree, const PointView& query_points, double distance, NeighborLists& found,
          const Execution& execution = {});

/// Resizes `inside` to the number of volumes. Sets inside[i] to 1 if PointTree::any_inside() holds for volume
/// i, else to 0.
void any_inside(const PointTree& tree, const std::vector<Sphere>& spheres, std::vector<std::uint8_t>& inside,
                const Execution& execution = {});
void any_inside(const PointTree& tree, const std::vector<AnyVolume>& volumes,
                std::vector<std::uint8_t>& inside, const Execution& execution = {});

}  // namespace pcl_bv
