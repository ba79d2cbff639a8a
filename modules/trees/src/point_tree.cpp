// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/trees/point_tree.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/trees/argument_checks.h"
#include "point_tree_state.h"
#include "vectors.h"

namespace pcl_bv {
using namespace detail;
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

const PackedTree& detail::packed_tree(const PointTree& tree) {
  return tree.state().tree;
}

PointTree::PointTree() = default;
PointTree::PointTree(const PointView& points, const Execution& execution) {
  assign(points, execution);
}
PointTree::~PointTree() = default;
PointTree::PointTree(PointTree&&) noexcept = default;
PointTree& PointTree::operator=(PointTree&&) noexcept = default;

PointTree::PointTree(const PointTree& other) {
  *this = other;
}

PointTree& PointTree::operator=(const PointTree& other) {
  if (this == &other || (!state_ && !other.state_)) return *this;
  if (!state_) state_ = std::make_unique<State>();
  state_->tree = other.state().tree;
  state_->isa = other.state().isa;
  state_->dropped = other.state().dropped;
  return *this;
}

const PointTree::State& PointTree::state() const {
  if (state_) return *state_;
  static const State empty;
  return empty;
}

std::size_t PointTree::size() const {
  return state().tree.count;
}

std::size_t PointTree::dropped() const {
  return state().dropped;
}

UsableIsa PointTree::isa() const {
  return state().isa;
}

void PointTree::assign(const PointView& points, const Execution& execution) {
  const FloatEnvironment environment;
  require_usable(points);
  if (!state_) state_ = std::make_unique<State>();
  try {
    build_tree(points, execution.parallel, state_->scratch, state_->tree);
  } catch (...) {
    state_->tree = {};
    throw;
  }
  state_->dropped = points.count - state_->tree.count;
  state_->isa = execution.isa;
}

void PointTree::refit(const PointView& cloud, const Execution& execution) {
  const FloatEnvironment environment;
  require_usable(cloud);
  if (cloud.indices != nullptr || cloud.scalar != state().tree.scalar)
    throw std::invalid_argument(
        "PointTree: refit() takes a cloud without an index list and with the tree's scalar type");
  const auto lacks = [&](std::int32_t index) {
    return index >= 0 && static_cast<std::size_t>(index) - cloud.first >= cloud.count;
  };
  const std::vector<std::int32_t>& indices = state().tree.indices;
  if (const auto at = std::find_if(indices.begin(), indices.end(), lacks); at != indices.end()) {
    throw std::invalid_argument("PointTree: refit(): the cloud has no point " + std::to_string(*at) +
                                ", which is in the tree");
  }
  if (state_) refit_tree(cloud, execution.parallel, state_->scratch, state_->tree);
}

std::optional<Neighbor> PointTree::nearest(const Eigen::Vector3d& point, double max_distance) const {
  const FloatEnvironment environment;
  const double limit = square_limit(max_distance);
  if (!is_valid(coordinates(point))) return std::nullopt;
  return find_nearest(state().isa, state().tree, coordinates(point), limit);
}

void PointTree::nearest(const Eigen::Vector3d& point, std::size_t k, std::vector<Neighbor>& found,
                        double max_distance) const {
  const FloatEnvironment environment;
  const double limit = square_limit(max_distance);
  found.clear();
  if (is_valid(coordinates(point)))
    list_nearest(state().isa, state().tree, coordinates(point), k, limit, found);
}

void PointTree::near(const Eigen::Vector3d& point, double distance, std::vector<Neighbor>& found) const {
  const FloatEnvironment environment;
  const double limit = square_limit(distance);
  found.clear();
  if (is_valid(coordinates(point))) list_in_ball(state().isa, state().tree, coordinates(point), limit, found);
}

bool PointTree::any_near(const Eigen::Vector3d& point, double distance) const {
  const FloatEnvironment environment;
  const double limit = square_limit(distance);
  return is_valid(coordinates(point)) && any_in_ball(state().isa, state().tree, coordinates(point), limit);
}

bool PointTree::any_inside(const Sphere& sphere) const {
  const FloatEnvironment environment;
  return !sphere.empty() &&
         any_in_ball(state().isa, state().tree, coordinates(sphere.center()), sphere.max_squared_distance());
}

}  // namespace pcl_bv
