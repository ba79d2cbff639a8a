// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/point_tree.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "argument_checks.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "tree_build.h"
#include "vectors.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kMaxPoints = std::numeric_limits<std::int32_t>::max();

void require_usable(const PointView& points) {
  if (points.source != nullptr) throw std::invalid_argument("PointTree: the points must be in memory");
  if (points.count > kMaxPoints || points.first > kMaxPoints - points.count) {
    std::ostringstream what;
    what << "PointTree: point indices must be from 0 to 2147483646, not " << points.first << " to "
         << points.first + points.count - 1;
    throw std::invalid_argument(what.str());
  }
}

}  // namespace

struct PointTree::Scratch : TreeScratch {};

PointTree::Scratch& PointTree::scratch() {
  if (!scratch_.scratch) scratch_.scratch = std::make_shared<Scratch>();
  return *scratch_.scratch;
}

void PointTree::assign(const PointView& points, const Execution& execution) {
  const FloatEnvironment environment;
  require_usable(points);
  try {
    build_tree(points, execution.parallel, scratch(), tree_);
  } catch (...) {
    tree_ = {};
    throw;
  }
  dropped_ = points.count - tree_.count;
  isa_ = execution.isa;
}

void PointTree::refit(const PointView& cloud, const Execution& execution) {
  const FloatEnvironment environment;
  require_usable(cloud);
  if (cloud.indices != nullptr || cloud.scalar != tree_.scalar)
    throw std::invalid_argument(
        "PointTree: refit() takes a cloud without an index list and with the tree's scalar type");
  const auto lacks = [&](std::int32_t index) {
    return index >= 0 && static_cast<std::size_t>(index) - cloud.first >= cloud.count;
  };
  if (const auto at = std::find_if(tree_.indices.begin(), tree_.indices.end(), lacks);
      at != tree_.indices.end()) {
    throw std::invalid_argument("PointTree: refit(): the cloud has no point " + std::to_string(*at) +
                                ", which is in the tree");
  }
  refit_tree(cloud, execution.parallel, scratch(), tree_);
}

std::optional<Neighbor> PointTree::nearest(const Eigen::Vector3d& point, double max_distance) const {
  const FloatEnvironment environment;
  const double limit = square_limit(max_distance);
  if (!is_valid(coordinates(point))) return std::nullopt;
  return find_nearest(isa_, tree_, coordinates(point), limit);
}

void PointTree::nearest(const Eigen::Vector3d& point, std::size_t k, std::vector<Neighbor>& found,
                        double max_distance) const {
  const FloatEnvironment environment;
  const double limit = square_limit(max_distance);
  found.clear();
  if (is_valid(coordinates(point))) list_nearest(isa_, tree_, coordinates(point), k, limit, found);
}

void PointTree::near(const Eigen::Vector3d& point, double distance, std::vector<Neighbor>& found) const {
  const FloatEnvironment environment;
  const double limit = square_limit(distance);
  found.clear();
  if (is_valid(coordinates(point))) list_in_ball(isa_, tree_, coordinates(point), limit, found);
}

bool PointTree::any_near(const Eigen::Vector3d& point, double distance) const {
  const FloatEnvironment environment;
  const double limit = square_limit(distance);
  return is_valid(coordinates(point)) && any_in_ball(isa_, tree_, coordinates(point), limit);
}

bool PointTree::any_inside(const Sphere& sphere) const {
  const FloatEnvironment environment;
  return !sphere.empty() &&
         any_in_ball(isa_, tree_, coordinates(sphere.center()), sphere.max_squared_distance());
}

}  // namespace pcl_bv
