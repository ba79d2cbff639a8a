// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Tolerances that grow with the distance from the origin, in steps of a quarter octave.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "distance.h"
#include "union_find.h"

namespace pcl_bv {

/// The tolerance of level i, tolerance * 2^(i/4), and the squared distance from the origin from which on
/// points have it or a greater one.
struct RangeLevel {
  double tolerance, least_squared_range;
};
RangeLevel range_level(float tolerance, float per_metre, std::size_t level);

/// Points that are linked at one level, put together over all. Two points are linked where they are nearer
/// than the smaller of their tolerances, that is, where they are linked at a level that both reach: so their
/// clusters are the union, over the levels, of the clusters among the points that reach the level.
template <typename T>
class RangeLevels {
 public:
  void start(const std::vector<Point<T>>& points);

  /// Goes on with the points that reach the level; false if there are none.
  bool climb(const RangeLevel& level);

  /// Of the current level.
  const std::vector<Point<T>>& points() const { return points_; }

  /// Point i of points() belongs to roots[node[i]].
  void unite(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node);

  /// After the last level, of the points of start().
  const std::vector<std::uint32_t>& roots() { return sets_.roots(); }

 private:
  std::vector<Point<T>> points_;
  std::vector<std::uint32_t> place_;  // of each in start()'s
  std::vector<std::uint32_t> first_;  // point of a root
  UnionFind sets_;
};

}  // namespace pcl_bv
