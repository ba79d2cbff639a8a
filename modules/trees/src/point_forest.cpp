// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/point_forest.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "argument_checks.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {
namespace {

template <typename T>
using Rows = std::vector<T>;

// Writes three coordinates per point of a tree to `rows`, at the row of the point's index.
template <typename T>
void write_points(const PackedTree& tree, T* rows) {
  const PointView points = tree.view();
  for (std::size_t place = 0; place < tree.count; ++place) {
    const Coordinates p = load_point(points, place);
    T* const row = rows + 3 * static_cast<std::size_t>(tree.indices[place]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      row[axis] = static_cast<T>(p[axis]);
  }
}

// Copies the visited points to rows, so that their indices become 0, 1, ...
template <typename T>
Rows<T> rows_of(const PointView& points) {
  Rows<T> rows(3 * points.count);
  for (std::size_t i = 0; i < points.count; ++i) {
    T p[3];
    load_point(points, i, p);
    std::copy_n(p, 3, rows.data() + 3 * i);
  }
  return rows;
}

template <typename T>
PointTree tree_of(const Rows<T>& rows, const Execution& execution) {
  return PointTree(PointView::of(rows.data(), 3 * sizeof(T), rows.size() / 3), execution);
}

}  // namespace

void PointForest::insert(const PointView& points, const Execution& execution) {
  Tree newest{{}, next_, points.count};
  if (points.source == nullptr && (points.indices != nullptr || points.first != 0)) {
    newest.tree = points.scalar == ScalarType::float32 ? tree_of(rows_of<float>(points), execution)
                                                       : tree_of(rows_of<double>(points), execution);
  } else {
    newest.tree.assign(points, execution);
  }
  if (points.count == 0 && kind_ == ForestTrees::merged) return;
  std::size_t kept = trees_.size();
  std::uint64_t count = points.count;
  for (; kind_ == ForestTrees::merged && kept > 0 && trees_[kept - 1].count < 2 * count; --kept)
    count += trees_[kept - 1].count;
  if (kept < trees_.size()) {
    std::vector<Tree> to_merge(trees_.begin() + static_cast<std::ptrdiff_t>(kept), trees_.end());
    to_merge.push_back(std::move(newest));
    newest = joined(to_merge.data(), to_merge.size(), execution);
    trees_.resize(kept);
  }
  trees_.push_back(std::move(newest));
  next_ += points.count;
}

PointForest::Tree PointForest::joined(const Tree* trees, std::size_t count, const Execution& execution) {
  const std::uint64_t first = trees[0].first,
                      points = trees[count - 1].first + trees[count - 1].count - first;
  if (points > std::numeric_limits<std::int32_t>::max())
    throw std::invalid_argument("PointForest: the merged tree would have " + std::to_string(points) +
                                " points, must be at most 2147483647");
  const bool floats = std::all_of(trees, trees + count, [](const Tree& tree) {
    return tree.tree.packed().scalar == ScalarType::float32 || tree.tree.empty();
  });
  // Builds the merged tree. Rows of invalid points stay NaN.
  const auto build = [&]<typename T>(T nan) {
    Rows<T> rows(3 * points, nan);
    for (std::size_t i = 0; i < count; ++i)
      write_points(trees[i].tree.packed(), rows.data() + 3 * (trees[i].first - first));
    return tree_of(rows, execution);
  };
  return {floats ? build(std::numeric_limits<float>::quiet_NaN())
                 : build(std::numeric_limits<double>::quiet_NaN()),
          first, points};
}

void PointForest::drop_oldest() {
  if (kind_ == ForestTrees::merged)
    throw std::logic_error("PointForest: drop_oldest() needs a forest of ForestTrees::kept");
  if (!trees_.empty()) trees_.pop_front();
}

std::size_t PointForest::size() const {
  std::size_t points = 0;
  for (const Tree& tree : trees_)
    points += tree.tree.size();
  return points;
}

std::optional<ForestNeighbor> PointForest::nearest(const Eigen::Vector3d& place, double max_distance) const {
  std::vector<ForestNeighbor> found;
  nearest(place, 1, found, max_distance);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

void PointForest::nearest(const Eigen::Vector3d& place, std::size_t k, std::vector<ForestNeighbor>& found,
                          double max_distance) const {
  const FloatEnvironment environment;
  found.clear();
  require_distance("PointForest", max_distance);
  std::vector<Neighbor> of_tree;
  // The first tree of a merged forest is the largest and mostly has the nearest points. They limit the search
  // in the other trees.
  for (const Tree& tree : trees_) {
    double limit = max_distance;
    if (k > 0 && found.size() == k) limit = std::min(limit, next_up(sqrt_up(found.back().squared_distance)));
    tree.tree.nearest(place, k, of_tree, limit);
    const auto middle = static_cast<std::ptrdiff_t>(found.size());
    for (const Neighbor& neighbor : of_tree)
      found.push_back({tree.first + static_cast<std::uint64_t>(neighbor.index), neighbor.squared_distance});
    std::inplace_merge(found.begin(), found.begin() + middle, found.end());
    found.resize(std::min(found.size(), k));
  }
}

void PointForest::near(const Eigen::Vector3d& place, double distance,
                       std::vector<ForestNeighbor>& found) const {
  found.clear();
  require_distance("PointForest", distance);
  std::vector<Neighbor> of_tree;
  for (const Tree& tree : trees_) {
    tree.tree.near(place, distance, of_tree);
    for (const Neighbor& neighbor : of_tree)
      found.push_back({tree.first + static_cast<std::uint64_t>(neighbor.index), neighbor.squared_distance});
  }
}

bool PointForest::any_inside(const Sphere& sphere) const {
  return std::any_of(trees_.begin(), trees_.end(),
                     [&](const Tree& tree) { return tree.tree.any_inside(sphere); });
}

}  // namespace pcl_bv
