// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Traversals of levels of boxes, for queries that have no vector kernel.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "pcl_bv/kernels/packed_tree.h"

namespace pcl_bv::detail {

/// Traverses the boxes depth-first. pick(group) returns a bit mask of the boxes of a group to enter. Calls
/// visit(item) for each box that is entered at level 0. Stops and returns true when visit() returns true.
template <typename Pick, typename Visit>
bool walk(const BoxLevels& boxes, std::size_t level, std::size_t group, const Pick& pick,
          const Visit& visit) {
  const std::size_t at = boxes.first[level] + group;
  for (std::uint32_t bits = pick(at); bits != 0; bits &= bits - 1) {
    const std::size_t below = group * kTreeWidth + static_cast<std::size_t>(std::countr_zero(bits));
    if (level == 0 ? visit(below) : walk(boxes, level - 1, below, pick, visit)) return true;
  }
  return false;
}

template <typename Pick, typename Visit>
bool walk(const BoxLevels& boxes, const Pick& pick, const Visit& visit) {
  return boxes.levels != 0 && walk(boxes, boxes.levels - 1, 0, pick, visit);
}

/// Calls visit(item) for the items whose lower bound is at most limit(). visit() may lower the limit. In each
/// group, boxes are entered in ascending order of their bounds. bounds(group) returns the bounds of the 16
/// boxes of a group. A box with an infinite bound is never entered. If the last group has fewer boxes, the
/// bounds of missing boxes are ignored.
template <typename Bounds, typename Limit, typename Visit>
void visit_nearest_first(const BoxLevels& boxes, std::size_t level, std::size_t group, const Bounds& bounds,
                         const Limit& limit, const Visit& visit) {
  struct Child {
    double bound;
    std::size_t item;
  };
  std::array<Child, kTreeWidth> children;
  const auto of_boxes = bounds(boxes.first[level] + group);
  const std::size_t first = group * kTreeWidth,
                    count = std::min(kTreeWidth, boxes.child_counts[level] - first);
  const double largest = std::min<double>(limit(), std::numeric_limits<double>::max());
  std::size_t entered = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double bound = of_boxes[k];
    if (!(bound <= largest)) continue;
    std::size_t position = entered++;  // insertion sort, because mostly few boxes are entered
    for (; position > 0 && bound < children[position - 1].bound; --position)
      children[position] = children[position - 1];
    children[position] = {bound, first + k};
  }
  for (std::size_t c = 0; c < entered && children[c].bound <= limit(); ++c) {
    if (level == 0) {
      visit(children[c].item);
    } else {
      visit_nearest_first(boxes, level - 1, children[c].item, bounds, limit, visit);
    }
  }
}

template <typename Bounds, typename Limit, typename Visit>
void visit_nearest_first(const BoxLevels& boxes, const Bounds& bounds, const Limit& limit,
                         const Visit& visit) {
  if (boxes.levels != 0) visit_nearest_first(boxes, boxes.levels - 1, 0, bounds, limit, visit);
}

}  // namespace pcl_bv::detail
