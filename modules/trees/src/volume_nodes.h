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

  const AnyVolume& volume(std::uint32_t number) const { return volumes[number]; }

  /// Calls visit(number of the volume) for those that may hold a place, and those without a box; ends where
  /// it returns true.
  template <typename Visit>
  bool visit_near(const Coordinates& place, const Visit& visit) const {
    const FramePlace at(boxes, place);
    const BoxQuery query = boxes.query(place, place);
    if (shapes.none()) return boxes.visit(query, visit);
    for (const std::uint32_t number : boxes.everywhere()) {
      if (visit(number)) return true;
    }
    const auto pick = [&](std::size_t group) {
      std::uint32_t bits = overlapping(boxes.levels().groups[group], query);
      for (std::uint32_t rest = bits; rest != 0; rest &= rest - 1) {
        const int k = std::countr_zero(rest);
        if (shapes.distance(group * kTreeWidth + static_cast<std::size_t>(k), at) > 0) bits &= ~(1U << k);
      }
      return bits;
    };
    return walk(boxes.levels(), pick, [&](std::size_t item) { return visit(boxes.number(item)); });
  }

  /// Calls visit(number) for the volumes whose bound(group, k) is at most limit(), which visit may lower: at
  /// first where it is least.
  template <typename Bound, typename Limit, typename Visit>
  void descend(const Bound& bound, const Limit& limit, const Visit& visit) const {
    const BoxLevels& levels = boxes.levels();
    for (std::size_t group = 0; levels.levels != 0 && group < levels.below[levels.levels]; ++group)
      descend(levels.levels - 1, group, bound, limit, visit);
  }

 private:
  template <typename Bound, typename Limit, typename Visit>
  void descend(std::size_t level, std::size_t group, const Bound& bound, const Limit& limit,
               const Visit& visit) const {
    struct Child {
      double bound;
      std::size_t item;
    };
    std::array<Child, kTreeWidth> children;
    const BoxLevels& levels = boxes.levels();
    const std::size_t first = group * kTreeWidth;
    const std::size_t count = std::min(kTreeWidth, levels.below[level] - first);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double least = bound(levels.first[level] + group, k);
      if (least <= limit() && least < std::numeric_limits<double>::infinity())
        children[kept++] = {least, first + k};
    }
    std::sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(kept),
              [](const Child& a, const Child& b) { return a.bound < b.bound; });
    for (std::size_t c = 0; c < kept && children[c].bound <= limit(); ++c) {
      if (level == 0) {
        visit(boxes.number(children[c].item));
      } else {
        descend(level - 1, children[c].item, bound, limit, visit);
      }
    }
  }
};

}  // namespace pcl_bv
