// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters with a tolerance that grows with the distance from the origin, in steps of a quarter octave.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "distance.h"
#include "union_find.h"

namespace pcl_bv {

/// The tolerance of level i, tolerance * 2^(i/4), and the squared distance from the origin from which points
/// have at least this tolerance.
struct RangeLevel {
  double tolerance, min_squared_range;
};
/// Returns a level for ClusterSettings::tolerance and tolerance_per_metre.
RangeLevel range_level(float tolerance, float per_metre, std::size_t level);

/// Unites the clusters of all levels. Two points are linked if they are nearer than the smaller of their
/// tolerances, that is, if they are linked at a level that both reach. So the clusters are the union, over
/// the levels, of the clusters of the points that reach the level.
template <typename T>
class RangeLevels {
 public:
  /// Starts with all points, each in a set of its own.
  void start(const std::vector<Point<T>>& points);

  /// Removes the points that do not reach the level. Returns false if none are left.
  bool advance_to(const RangeLevel& level);

  /// Returns the points that reach the current level.
  const std::vector<Point<T>>& points() const { return points_; }

  /// Unites the points with the same root at this level: point i of points() has the root roots[node[i]].
  void unite(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node);

  /// Returns the root of each point of start(). Call after the last level.
  const std::vector<std::uint32_t>& roots() { return sets_.roots(); }

 private:
  std::vector<Point<T>> points_;
  std::vector<std::uint32_t> position_;       // position of each point in those of start()
  std::vector<std::uint32_t> first_of_root_;  // for each root, a point that has it
  UnionFind sets_;
};

}  // namespace pcl_bv
