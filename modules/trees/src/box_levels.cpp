// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_bv::detail {
namespace {

std::size_t groups_of(std::size_t below) {
  return (below + kTreeWidth - 1) / kTreeWidth;
}

// Returns an error bound for the rounding to float in set_item_box() and for the two roundings in double
// before it. The second term of the sum is for denormal floats.
float rounding_error_bound(float rounded) {
  return std::abs(rounded) * 0x1p-22F + std::numeric_limits<float>::min();
}

const BoxGroup& empty_group() {
  static const BoxGroup group = [] {
    BoxGroup made;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::fill_n(made.low[axis], kTreeWidth, std::numeric_limits<float>::infinity());
      std::fill_n(made.high[axis], kTreeWidth, -std::numeric_limits<float>::infinity());
    }
    return made;
  }();
  return group;
}

// For each face of each box of the group, consider the ball around the middle of the face that covers the
// face. Returns the squared radius of the smallest such ball. Each face of a tight box has a point, so this
// ball holds at least one point.
float min_side_radius(const BoxGroup& group) {
  float smallest = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < kTreeWidth; ++k) {
    const float x = group.high[0][k] - group.low[0][k], y = group.high[1][k] - group.low[1][k],
                z = group.high[2][k] - group.low[2][k];
    smallest = std::min({smallest, x * x + y * y, y * y + z * z, z * z + x * x});
  }
  return smallest / 4;
}

}  // namespace

void reset_levels(BoxLevels& boxes, std::size_t items, const PositionBounds& bounds) {
  boxes.levels = 0;
  boxes.child_counts[0] = items;
  if (items == 0) {
    boxes.groups.clear();
    return;
  }
  do {
    const std::size_t groups = groups_of(boxes.child_counts[boxes.levels]);
    ++boxes.levels;
    boxes.first[boxes.levels] = boxes.first[boxes.levels - 1] + groups;
    boxes.child_counts[boxes.levels] = groups;
  } while (boxes.child_counts[boxes.levels] > 1);
  boxes.groups.assign(boxes.first[boxes.levels], empty_group());
  if (!(bounds.low.x <= bounds.high.x)) return;  // no item has a position
  double half = 0;
  const auto middle = [&half](double low, double high) {
    const double at = low / 2 + high / 2;
    half = std::max({half, high - at, at - low});
    return at;
  };
  boxes.origin = {middle(bounds.low.x, bounds.high.x), middle(bounds.low.y, bounds.high.y),
                  middle(bounds.low.z, bounds.high.z)};
  // Clouds with a half extent of at most 2^-400 are not scaled, because the square of their scale could leave
  // the range of double. All boxes of such a cloud are nearly the same, because rounding_error_bound() is at
  // least 2^-126.
  boxes.scale = std::ldexp(1.0, half > 0x1p-400 ? -std::ilogb(half) - 1 : 0);
}

void set_item_box(BoxLevels& boxes, std::size_t item, const Coordinates& low, const Coordinates& high) {
  BoxGroup& group = boxes.groups[item / kTreeWidth];
  const std::size_t k = item % kTreeWidth;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto smallest = static_cast<float>((low[axis] - boxes.origin[axis]) * boxes.scale);
    const auto largest = static_cast<float>((high[axis] - boxes.origin[axis]) * boxes.scale);
    group.low[axis][k] = smallest - rounding_error_bound(smallest);
    group.high[axis][k] = largest + rounding_error_bound(largest);
  }
}

void raise_levels(BoxLevels& boxes) {
  for (std::size_t level = 1; level < boxes.levels; ++level) {
    for (std::size_t item = 0; item < boxes.child_counts[level]; ++item) {
      const BoxGroup& from = boxes.groups[boxes.first[level - 1] + item];
      BoxGroup& to = boxes.groups[boxes.first[level] + item / kTreeWidth];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        to.low[axis][item % kTreeWidth] = *std::min_element(from.low[axis], from.low[axis] + kTreeWidth);
        to.high[axis][item % kTreeWidth] = *std::max_element(from.high[axis], from.high[axis] + kTreeWidth);
      }
    }
  }
}

void find_min_side_radii(BoxLevels& boxes) {
  boxes.min_side_radius.resize(boxes.groups.size());
  std::transform(boxes.groups.begin(), boxes.groups.end(), boxes.min_side_radius.begin(), min_side_radius);
}

}  // namespace pcl_bv::detail
