// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Many questions at once, over all cores: each answer is that of the one question.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/trees/point_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Lists of neighbours, one after another: those of place i are neighbors[first[i]] to neighbors[first[i + 1]
/// - 1].
struct NeighborLists {
  std::vector<Neighbor> neighbors;
  std::vector<std::size_t> first;
};

/// The nearest point of each place, as PointTree::nearest(); index -1 and distance infinity where there is
/// none. Replaces the contents of `found`. Throws std::invalid_argument unless the places are in memory, and
/// what nearest() throws.
void nearest(const PointTree& tree, const PointView& places, std::vector<Neighbor>& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// The k nearest points of each place, ascending. Throws likewise.
void nearest(const PointTree& tree, const PointView& places, std::size_t k, NeighborLists& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// All points within a distance of each place, ascending (Neighbor's order). Throws likewise.
void near(const PointTree& tree, const PointView& places, double distance, NeighborLists& found,
          const Execution& execution = {});

/// Sets inside[i] to 1 where any_inside() of volume i holds, else to 0.
void any_inside(const PointTree& tree, const std::vector<Sphere>& spheres, std::vector<std::uint8_t>& inside,
                const Execution& execution = {});
void any_inside(const PointTree& tree, const std::vector<AnyVolume>& volumes,
                std::vector<std::uint8_t>& inside, const Execution& execution = {});

}  // namespace pcl_bv
