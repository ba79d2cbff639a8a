// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The data of a VolumeTree, which are its volumes and the bounds of its nodes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "node_bounds.h"
#include "pcl_bv/trees/volume_tree.h"
#include "volume_boxes.h"

namespace pcl_bv {

struct VolumeTree::Nodes {
  std::vector<AnyVolume> volumes;
  NodeBounds kind = NodeBounds::aabb;
  VolumeBoxes boxes;
  NodeShapes shapes;
  std::vector<std::uint32_t> too_flat_for_rays;  // ellipsoids that every ray tests without a box

  /// Builds the boxes and shapes. Sorts the volumes anew if `new_order` is true.
  void measure(bool new_order, const Execution& execution);

  /// Calls visit(index) for the volumes that may hold a point, and for the volumes without a box. Stops and
  /// returns true when visit() returns true.
  template <typename Visit>
  bool visit_candidates_at(const Coordinates& point, const Visit& visit) const {
    const BoxQuery query = boxes.query(point, point);
    if (shapes.none()) return boxes.visit(query, visit);
    const FramePoint at(boxes, point);
    for (const std::uint32_t index : boxes.without_box()) {
      if (visit(index)) return true;
    }
    const auto pick = [&](std::size_t group) {
      return shapes.may_contain(group, overlapping(boxes.levels().groups[group], query), at);
    };
    return walk(boxes.levels(), pick, [&](std::size_t item) { return visit(boxes.volume_index(item)); });
  }

  /// Calls visit(index) for the volumes with a box whose bound(group, k) is at most limit(), in the order of
  /// visit_nearest_first().
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
