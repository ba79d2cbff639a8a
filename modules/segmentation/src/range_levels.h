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
#include "union_find.h"

namespace pcl_bv::detail {

/// Level i has the tolerance ClusterOptions::tolerance * 2^(i/4). A point has at least this tolerance if its
/// squared range is at least min_squared_range.
struct RangeLevel {
  double tolerance, min_squared_range;
};
/// Returns level number `level` for ClusterOptions::tolerance and tolerance_per_metre.
RangeLevel range_level(float tolerance, float per_metre, std::size_t level);

/// Unites the clusters of all levels. A point is at a level if its tolerance is at least that of the level.
/// Two points are linked if their distance is below the smaller of their tolerances, that is, if they are
/// linked at some level that both points are at. So the clusters are the union, over the levels, of the
/// clusters of the points at the level.
template <typename T>
class RangeLevels {
 public:
  /// Starts with all points, each in a separate set.
  void start(const std::vector<Point<T>>& points);

  /// Removes the points that are not at the level. Ranges are measured from `origin`. Returns false if no
  /// point remains.
  bool advance_to(const RangeLevel& level, const Eigen::Vector3d& origin);

  /// Returns the points at the current level.
  const std::vector<Point<T>>& points() const { return points_; }

  /// Unites the points that have the same root at this level. The root of point i of points() is
  /// roots[node[i]].
  void unite(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node);

  /// Returns the root of each point passed to start(). Call it after the last level.
  const std::vector<std::uint32_t>& roots() { return sets_.roots(); }

 private:
  std::vector<Point<T>> points_;
  std::vector<std::uint32_t> position_;       // position of each point in the list passed to start()
  std::vector<std::uint32_t> first_of_root_;  // for each root, the first point with this root
  UnionFind sets_;
};

}  // namespace pcl_bv::detail
