// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters for ClusterOptions::tolerance_per_metre. The tolerance grows with the distance from
// ClusterOptions::range_origin, by a factor of 2^(1/4) from level to level.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "distance.h"
#include "pcl_bv/segmentation/clusters.h"
#include "union_find.h"

namespace pcl_bv::detail {

/// Unites the clusters of all levels. Level i has the tolerance ClusterOptions::tolerance * 2^(i/4), rounded to
/// float. A point is at the highest level whose tolerance it has, so at level i it is at least range(i) from
/// ClusterOptions::range_origin.
///
/// Two points are linked if their distance is below the smaller of their tolerances, i.e. if they are linked
/// at the level of one of them, and the other one is at this level or above. So the clusters are the union,
/// over the levels, of the clusters of the points at the level and of the points above it that are not too
/// far out to be linked to them. These are at most 4 log2(1.2 + 2 tolerance_per_metre) + 1 levels above.
template <typename T>
class RangeLevels {
 public:
  /// Starts with all points, each in a separate set, before the first level.
  void start(const std::vector<Point<T>>& points, const ClusterOptions& options);

  /// Moves to the next level that has points. Returns false after the last level.
  bool next();

  float tolerance() const { return levels_[level_].tolerance; }  ///< Of the current level.

  /// Returns the points at the current level, and those above it that may be linked to them.
  const std::vector<Point<T>>& points() const { return points_; }

  /// Unites the points that have the same root at this level. The root of point i of points() is
  /// roots[node[i]].
  void unite(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node);

  /// Returns the root of each point passed to start(). Call it after the last level.
  const std::vector<std::uint32_t>& roots() { return sets_.roots(); }

 private:
  struct Level {
    float tolerance;
    double range, squared_range;  // the smallest of points at the level
    std::uint32_t begin;          // of its points in sorted_
  };

  void add_levels(double max_squared_range, float tolerance, float per_metre);
  double squared_range(const Point<T>& p) const;
  std::size_t level_of(const Point<T>& p) const;

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<Level> levels_;  // and one after the last, with no points
  std::size_t level_ = 0;
  std::vector<Point<T>> sorted_;         // all points, by level
  std::vector<std::uint32_t> position_;  // position of each of these in the list passed to start()
  std::vector<Point<T>> points_;
  std::vector<std::uint32_t> first_of_root_;  // for each root, the first point with this root
  UnionFind sets_;
};

}  // namespace pcl_bv::detail
