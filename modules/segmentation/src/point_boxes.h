// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A tree of boxes over consecutive points, for cells with very many points.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "distance.h"
#include "neighbourhood.h"

namespace pcl_bv::detail {

/// Number of points in a group, which has a box.
inline constexpr std::uint32_t group_size = 32;

/// The boxes of groups of points, and of 2, 4, 8, ... groups. A group has the points at positions g *
/// group_size to (g + 1) * group_size. A last group with fewer points has no box.
template <typename T>
class PointBoxes {
 public:
  /// Makes the boxes from those of the groups, box(g).
  template <typename BoxOfGroup>
  void make(std::size_t groups, const BoxOfGroup& box) {
    boxes_.resize(
        std::max<std::size_t>({boxes_.size(), static_cast<std::size_t>(std::bit_width(groups)), 1}));
    boxes_[0].resize(groups);
    for (std::size_t g = 0; g < groups; ++g)
      boxes_[0][g] = box(g);
    for (std::size_t level = 1; level < boxes_.size(); ++level) {
      const std::vector<Box<T>>& halves = boxes_[level - 1];
      boxes_[level].resize(halves.size() / 2);
      for (std::size_t i = 0; i < boxes_[level].size(); ++i) {
        Box<T>& whole = boxes_[level][i] = halves[2 * i];
        whole.extend(halves[2 * i + 1]);
      }
    }
  }

  const Box<T>& of_group(std::size_t group) const { return boxes_[0][group]; }

  /// Calls test(begin, end) for the positions of a run, split at multiples of group_size. Skips the points of
  /// a box if skip(box, number of points) is true. Takes the half of a box that is nearer to p first. Stops
  /// and returns false when test() returns false.
  template <typename Skip, typename Test>
  bool visit(const PositionRange& run, const Point<T>& p, const Skip& skip, const Test& test) const {
    for (std::uint32_t i = run.begin; i < run.end;) {
      const std::uint32_t group_end = (i / group_size + 1) * group_size;
      std::uint32_t end = std::min(run.end, group_end);
      if (i + group_size != end) {
        if (!test(i, end)) return false;
      } else {
        std::size_t level = 0;  // the largest box that begins at i and ends within the run
        for (std::uint64_t size = 2 * group_size; i % size == 0 && size <= run.end - i; size *= 2, ++level)
          end = i + static_cast<std::uint32_t>(size);
        if (!in_box(level, i / (end - i), p, skip, test)) return false;
      }
      i = end;
    }
    return true;
  }

 private:
  template <typename Skip, typename Test>
  bool in_box(std::size_t level, std::uint32_t box, const Point<T>& p, const Skip& skip,
              const Test& test) const {
    if (skip(boxes_[level][box], group_size << level)) return true;
    if (level == 0) return test(box * group_size, (box + 1) * group_size);
    const Box<T> at{p, p};
    const Box<T>* const halves = &boxes_[level - 1][2 * std::size_t{box}];
    const bool swap = min_squared_distance(at, halves[1]) < min_squared_distance(at, halves[0]);
    const std::uint32_t near = 2 * box + (swap ? 1 : 0);
    return in_box(level - 1, near, p, skip, test) && in_box(level - 1, near ^ 1U, p, skip, test);
  }

  std::vector<std::vector<Box<T>>> boxes_;
};

/// A point and its index in the input of make_cells().
template <typename T>
struct CellPoint {
  Point<T> point;
  std::uint32_t number;
};

/// Sorts points, which are at consecutive positions from `begin` on, so that the points of a box are near
/// each other: splits them at the position where the largest boxes end, along the longest side of their box.
template <typename T>
void sort_for_boxes(CellPoint<T>* points, std::uint32_t begin, std::uint32_t end) {
  const std::uint32_t size = std::bit_floor(begin ^ (end - 1));
  if (size < group_size) return;
  const std::uint32_t middle = (end - 1) & ~(size - 1);
  Box<T> box{points->point, points->point};
  for (std::uint32_t i = 0; i < end - begin; ++i)
    box.extend(points[i].point);
  const auto axis = longest_axis(box);
  CellPoint<T>* const half = points + (middle - begin);
  std::nth_element(points, half, points + (end - begin),
                   [axis](const auto& p, const auto& q) { return p.point.*axis < q.point.*axis; });
  sort_for_boxes(points, begin, middle);
  sort_for_boxes(half, middle, end);
}

}  // namespace pcl_bv::detail
