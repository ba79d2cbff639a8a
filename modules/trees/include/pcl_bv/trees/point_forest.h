// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Questions to points that come batch by batch: a map that grows, or the last sweeps.
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

/// A point of a forest and how far it is, as Neighbor says.
struct ForestNeighbor {
  std::uint64_t number;
  double squared_distance;
};

/// The nearer one first; of equal ones that with the smaller number.
inline bool operator<(const ForestNeighbor& a, const ForestNeighbor& b) {
  return a.squared_distance < b.squared_distance ||
         (a.squared_distance == b.squared_distance && a.number < b.number);
}

enum class ForestTrees : std::uint8_t {
  merged,  ///< O(log n) trees (Bentley, Saxe 1980): batches that came one after another share one.
  kept     ///< One for each batch, which can leave again.
};

/// Several PointTrees, asked as one. Points are numbered from 0 as they come, whatever they are called in
/// their view, those that are not valid too; numbers are never used again. Answers are those of one PointTree
/// of all points.
///
/// `merged`: a batch becomes a tree; as long as the tree before is less than twice as large as all after it,
/// they are built anew as one. So there are at most log2(n) + 1 trees, each twice as large as the next, and a
/// point is built into a tree that is half as large again each time. `kept`: as many trees as batches; a
/// question asks them all.
///
/// Const calls may run side by side.
class PointForest {
 public:
  explicit PointForest(ForestTrees trees = ForestTrees::merged) : kind_(trees) {}

  /// Adds the visited points, with an index list or without. O(n), or amortised O(n log(N)) where trees are
  /// merged. Throws std::invalid_argument as PointTree's constructor does, and where trees would be merged to
  /// more than 2^31 - 1 points; then nothing is changed.
  void insert(const PointView& points, const Execution& execution = {});

  /// The oldest batch leaves, if there is one. Throws std::logic_error where trees are merged.
  void drop_oldest();

  std::size_t size() const;                         ///< Points in the trees, valid ones.
  std::uint64_t inserted() const { return next_; }  ///< Points that ever came: the number of the next one.
  std::size_t trees() const { return trees_.size(); }

  /// As PointTree's, but for the numbers.
  std::optional<ForestNeighbor> nearest(const Eigen::Vector3d& place,
                                        double max_distance = std::numeric_limits<double>::infinity()) const;
  void nearest(const Eigen::Vector3d& place, std::size_t k, std::vector<ForestNeighbor>& found,
               double max_distance = std::numeric_limits<double>::infinity()) const;
  void near(const Eigen::Vector3d& place, double distance, std::vector<ForestNeighbor>& found) const;
  bool any_inside(const Sphere& sphere) const;

 private:
  struct Tree {
    PointTree tree;       // which calls its first point 0
    std::uint64_t first;  // what it is here
    std::uint64_t count;  // numbers, also of points that are not valid
  };

  static Tree joined(const Tree* trees, std::size_t count, const Execution& execution);

  ForestTrees kind_;
  std::deque<Tree> trees_;  // from the oldest to the newest
  std::uint64_t next_ = 0;
};

}  // namespace pcl_bv
