// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

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
  std::vector<std::uint32_t> loose;  // those that rays ask without a box

  void measure(bool anew, const Execution& execution);

  /// Calls visit(number of the volume) for those that may hold a place, and those without a box; ends where
  /// it returns true.
  template <typename Visit>
  bool visit_near(const Coordinates& place, const Visit& visit) const {
    const BoxQuery query = boxes.query(place, place);
    if (shapes.none()) return boxes.visit(query, visit);
    const FramePlace at(boxes, place);
    for (const std::uint32_t number : boxes.everywhere()) {
      if (visit(number)) return true;
    }
    const auto pick = [&](std::size_t group) {
      return shapes.may_hold(group, overlapping(boxes.levels().groups[group], query), at);
    };
    return walk(boxes.levels(), pick, [&](std::size_t item) { return visit(boxes.number(item)); });
  }

  /// Calls visit(number) for the volumes whose bound(group, k) is at most limit(), as descend() says.
  template <typename Bound, typename Limit, typename Visit>
  void nearest_first(const Bound& bound, const Limit& limit, const Visit& visit) const {
    const auto bounds = [&](std::size_t group) {
      std::array<double, kTreeWidth> found;
      for (std::size_t k = 0; k < kTreeWidth; ++k)
        found[k] = bound(group, k);
      return found;
    };
    descend(boxes.levels(), bounds, limit, [&](std::size_t item) { visit(boxes.number(item)); });
  }
};

}  // namespace pcl_bv
