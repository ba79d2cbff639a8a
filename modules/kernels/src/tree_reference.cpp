// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <limits>

#include "references.h"

namespace pcl_bv::detail {
namespace {

// Returns a lower bound of the squared distance between a query point and box k of a group, in the unit of
// the items.
double least_square(const BoxLevels& boxes, const BoxGroup& group, std::size_t k, const Coordinates& center) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double position = (center[axis] - boxes.origin[axis]) * boxes.scale;
    const double gap = std::max(group.low[axis][k] - position, position - group.high[axis][k]);
    const double lower_bound = (gap - 0x1p-50 * std::abs(position)) / boxes.scale;
    if (lower_bound > 0) sum += lower_bound * lower_bound;
  }
  return sum * (1 - 0x1p-40);
}

// Calls take(packet) for each packet below an item if near(group, k) holds for all boxes between the item and
// the packet. Stops and returns true as soon as take() returns true.
template <typename Near, typename Take>
bool visit_packets(const BoxLevels& boxes, std::size_t level, std::size_t item, const Near& near,
                   const Take& take) {
  if (level == 0) return take(item);
  const std::size_t first = item * kTreeWidth;
  const BoxGroup& group = boxes.groups[boxes.first[level - 1] + item];
  for (std::size_t k = 0; k < kTreeWidth && first + k < boxes.child_counts[level - 1]; ++k) {
    if (near(group, k) && visit_packets(boxes, level - 1, first + k, near, take)) return true;
  }
  return false;
}

Coordinates point_of(const PackedTree& tree, std::size_t packet, std::size_t lane) {
  const auto of = [&](const auto& points) -> Coordinates {
    return {*points.at(0, lane), *points.at(1, lane), *points.at(2, lane)};
  };
  return tree.scalar == ScalarType::float32 ? of(tree.floats[packet]) : of(tree.doubles[packet]);
}

// Calls take(Neighbor) for all points whose squared distance is at most limit(). take() may lower limit().
// Stops and returns true as soon as take() returns true.
template <typename Limit, typename Take>
bool visit_ball(const PackedTree& tree, const Coordinates& center, const Limit& limit, const Take& take) {
  const auto near = [&](const BoxGroup& group, std::size_t k) {
    return least_square(tree.boxes, group, k, center) <= limit();
  };
  return visit_packets(tree.boxes, tree.boxes.levels, 0, near, [&](std::size_t packet) {
    const std::size_t first = packet * kTreeWidth;
    for (std::size_t lane = 0; lane < kTreeWidth && first + lane < tree.count; ++lane) {
      const Coordinates p = point_of(tree, packet, lane);
      const double x = p.x - center.x, y = p.y - center.y, z = p.z - center.z;
      const double square = (x * x + y * y) + z * z;
      if (square <= limit() && take(Neighbor{tree.indices[first + lane], square})) return true;
    }
    return false;
  });
}

template <typename Kept>
void visit_nearest(const PackedTree& tree, const Coordinates& center, Kept& kept) {
  visit_ball(
      tree, center, [&] { return kept.limit(); },
      [&](const Neighbor& neighbor) {
        kept.offer(neighbor);
        return false;
      });
}

// Returns the number of steps after which the ball enters box k of a group. Returns infinity if the ball does
// not enter the box.
float steps_to_box(const BoxGroup& group, std::size_t k, const SweptBall& ball) {
  float enter = 0, leave = std::numeric_limits<float>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool up = ball.inverse[axis] > 0;
    const float near = (up ? group.low : group.high)[axis][k], far = (up ? group.high : group.low)[axis][k];
    enter = std::max(enter, near * ball.inverse[axis] - ball.to_near[axis]);
    leave = std::min(leave, far * ball.inverse[axis] - ball.to_far[axis]);
  }
  return enter <= leave ? enter : std::numeric_limits<float>::infinity();
}

}  // namespace

bool any_in_ball_reference(const PackedTree& tree, const Coordinates& center, double limit) {
  return visit_ball(
      tree, center, [&] { return limit; }, [](const Neighbor&) { return true; });
}

void list_in_ball_reference(const PackedTree& tree, const Coordinates& center, double limit,
                            std::vector<Neighbor>& found) {
  visit_ball(
      tree, center, [&] { return limit; },
      [&](const Neighbor& neighbor) {
        found.push_back(neighbor);
        return false;
      });
}

void list_nearest_reference(const PackedTree& tree, const Coordinates& center, NearestSet& kept) {
  visit_nearest(tree, center, kept);
}

void find_nearest_reference(const PackedTree& tree, const Coordinates& center, NearestOne& kept) {
  visit_nearest(tree, center, kept);
}

void visit_along_reference(const PackedTree& tree, const SweptBall& ball, PacketVisitor& visitor) {
  float latest = std::numeric_limits<float>::max();
  const auto near = [&](const BoxGroup& group, std::size_t k) {
    return steps_to_box(group, k, ball) <= latest;
  };
  visit_packets(tree.boxes, tree.boxes.levels, 0, near, [&](std::size_t packet) {
    std::uint32_t points = 0;
    for (std::size_t lane = 0; lane < kTreeWidth; ++lane) {
      const TouchBounds touch =
          ball.touch(point_of(tree, packet, lane), std::numeric_limits<double>::infinity());
      points |= static_cast<std::uint32_t>(touch.is_possible()) << lane;
    }
    if (points != 0) latest = visitor.visit(packet, points);
    return false;
  });
}

}  // namespace pcl_bv::detail
