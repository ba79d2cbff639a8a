// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A set of search trees over points that arrive in batches, e.g. a growing map or the last sweeps.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "pcl_bv/trees/point_tree.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// A point of a forest and its squared distance from the query point, computed as in Neighbor.
struct ForestNeighbor {
  /// Number of the point in the forest.
  std::uint64_t number;
  double squared_distance;
};

/// Orders by distance, then by number.
inline bool operator<(const ForestNeighbor& a, const ForestNeighbor& b) {
  return a.squared_distance < b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.number < b.number);
}

/// How the batches of a PointForest are stored.
enum class ForestTrees : std::uint8_t {
  merged,  ///< In O(log n) trees (Bentley, Saxe 1980); successive batches share a tree.
  kept     ///< In one tree per batch; drop_oldest() removes the oldest.
};

/// Several PointTrees that are queried as one. Queries give the same results as one PointTree of all points.
///
/// Points are numbered from 0 in the order of insertion, including invalid points. The indices of the views
/// are ignored. Numbers are never reused.
///
/// With ForestTrees::merged, insert() rebuilds the newest trees and the new batch as one tree until each tree
/// has at least twice as many points as the next. So there are at most log2(n) + 1 trees. A rebuild puts the
/// points of an older tree into a tree at least 1.5 times as large. With ForestTrees::kept, there are as many
/// trees as batches, and a query visits them all.
///
/// Const member functions may be called from several threads at the same time.
class PointForest {
 public:
  /// Makes a forest without points.
  explicit PointForest(ForestTrees trees = ForestTrees::merged) : kind_(trees) {}

  /// Adds the n visited points of a view, with or without an index list, and builds a tree of these points.
  /// With ForestTrees::merged, each of N points is rebuilt O(log N) times in all. Throws
  /// std::invalid_argument, and changes nothing, in the cases in which the constructor of PointTree throws,
  /// and if a merged tree would have more than 2^31 - 1 points.
  void insert(const PointView& points, const Execution& execution = {});

  /// Removes the oldest batch, if there is one. Throws std::logic_error for ForestTrees::merged.
  void drop_oldest();

  std::size_t size() const;                         ///< Number of valid points in the trees.
  std::uint64_t inserted() const { return next_; }  ///< Number of points ever inserted.
  /// Number of trees.
  std::size_t trees() const { return trees_.size(); }

  /// Like the PointTree member functions of the same name, with forest numbers instead of indices.
  std::optional<ForestNeighbor> nearest(const Eigen::Vector3d& place,
                                        double max_distance = std::numeric_limits<double>::infinity()) const;
  void nearest(const Eigen::Vector3d& place, std::size_t k, std::vector<ForestNeighbor>& found,
               double max_distance = std::numeric_limits<double>::infinity()) const;
  void near(const Eigen::Vector3d& place, double distance, std::vector<ForestNeighbor>& found) const;
  bool any_inside(const Sphere& sphere) const;

 private:
  struct Tree {
    PointTree tree;       // its point indices start at 0
    std::uint64_t first;  // forest number of its first point
    std::uint64_t count;  // number of points, including invalid ones
  };

  static Tree joined(const Tree* trees, std::size_t count, const Execution& execution);

  ForestTrees kind_;
  std::deque<Tree> trees_;  // oldest first
  std::uint64_t next_ = 0;
};

}  // namespace pcl_bv
