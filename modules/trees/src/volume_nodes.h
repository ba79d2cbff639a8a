// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The data of a VolumeTree: its volumes, the boxes around them, and the list too_flat_for_rays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "box_bounds.h"
#include "pcl_bv/trees/volume_tree.h"
#include "volume_boxes.h"

namespace pcl_bv {
using namespace detail;

struct VolumeTree::Nodes {
  std::vector<AnyVolume> volumes;
  VolumeBoxes boxes;
  std::vector<std::uint32_t> too_flat_for_rays;  // ellipsoids that every ray tests without a box

  /// Builds the boxes. Sorts the volumes anew if `new_order` is true.
  void measure(bool new_order, const Execution& execution);

  /// Calls visit(index) for the volumes that may hold a point, and for the volumes without a box. Stops and
  /// returns true when visit() returns true.
  template <typename Visit>
  bool visit_candidates_at(const Coordinates& point, const Visit& visit) const {
    return boxes.visit(boxes.query(point, point), visit);
  }

  /// Calls visit(index) for the volumes that have a box and whose lower bound, bound(group, k), is at most
  /// limit(). The order is that of visit_nearest_first().
  template <typename Bound, typename Limit, typename Visit>
  void nearest_first(const Bound& bound, const Limit& limit, const Visit& visit) const {
    const auto bounds = [&](std::size_t group) {
      std::array<double, kTreeWidth> found;
      for (std::size_t k = 0; k < kTreeWidth; ++k)
        found[k] = bound(group, k);
      return found;
    };
    visit_nearest_first(boxes.levels(), bounds, limit,
                        [&](std::size_t item) { visit(boxes.volume_index(item)); });
  }
};

}  // namespace pcl_bv
