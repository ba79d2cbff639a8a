// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>

#include "references.h"

namespace pcl_bv {
namespace {

// A lower bound of the squared distance between a place and box k of a group, in the unit of the items.
double least_square(const BoxLevels& boxes, const BoxGroup& group, std::size_t k, const Coordinates& center) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place = (center[axis] - boxes.origin[axis]) * boxes.scale;
    const double gap = std::max(group.low[axis][k] - place, place - group.high[axis][k]);
    const double sure = gap - 0x1p-50 * std::abs(place);
    if (sure > 0) sum += sure * sure;
  }
  return sum / boxes.scale / boxes.scale * (1 - 0x1p-40);
}

// Calls take(point number, squared distance) for all points in boxes whose bound is at most limit(), which
// take may lower; ends where it returns true.
template <typename Limit, typename Take>
bool visit(const PackedTree& tree, std::size_t level, std::size_t item, const Coordinates& center,
           const Limit& limit, const Take& take) {
  if (level == 0) {
    for (std::size_t lane = 0; lane < kTreeWidth && item * kTreeWidth + lane < tree.count; ++lane) {
      const auto square_to = [&](const auto& packet) {
        const double x = *packet.at(0, lane) - center.x, y = *packet.at(1, lane) - center.y,
                     z = *packet.at(2, lane) - center.z;
        return (x * x + y * y) + z * z;
      };
      const double square =
          tree.scalar == ScalarType::float32 ? square_to(tree.floats[item]) : square_to(tree.doubles[item]);
      if (square <= limit() && take(Neighbor{tree.numbers[item * kTreeWidth + lane], square})) return true;
    }
    return false;
  }
  const std::size_t first = item * kTreeWidth;
  const BoxGroup& group = tree.boxes.groups[tree.boxes.first[level - 1] + item];
  for (std::size_t k = 0; k < kTreeWidth && first + k < tree.boxes.below[level - 1]; ++k) {
    if (least_square(tree.boxes, group, k, center) <= limit() &&
        visit(tree, level - 1, first + k, center, limit, take)) {
      return true;
    }
  }
  return false;
}

template <typename Kept>
void visit_nearest(const PackedTree& tree, const Coordinates& center, Kept& kept) {
  visit(
      tree, tree.boxes.levels, 0, center, [&] { return kept.limit(); },
      [&](const Neighbor& neighbor) {
        kept.offer(neighbor);
        return false;
      });
}

}  // namespace

bool any_in_ball_reference(const PackedTree& tree, const Coordinates& center, double limit) {
  return visit(
      tree, tree.boxes.levels, 0, center, [&] { return limit; }, [](const Neighbor&) { return true; });
}

void list_in_ball_reference(const PackedTree& tree, const Coordinates& center, double limit,
                            std::vector<Neighbor>& found) {
  visit(
      tree, tree.boxes.levels, 0, center, [&] { return limit; },
      [&](const Neighbor& neighbor) {
        found.push_back(neighbor);
        return false;
      });
}

void list_nearest_reference(const PackedTree& tree, const Coordinates& center, NearestKept& kept) {
  visit_nearest(tree, center, kept);
}

void find_nearest_reference(const PackedTree& tree, const Coordinates& center, NearestOne& kept) {
  visit_nearest(tree, center, kept);
}

}  // namespace pcl_bv
