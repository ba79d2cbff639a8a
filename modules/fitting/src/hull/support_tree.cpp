// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Branch and bound in rounded local coordinates. Points whose projection is within the error bound of the
// maximum are compared exactly.

#include "hull/support_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "box/rectangle.h"
#include "orthogonal_basis.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/exact_dot.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kLeafPoints = 8;
constexpr std::size_t kFewQueries = 64;

// Error bound of a projection. Local coordinates are at most 2, with an error of at most 4 2^-53. The
// products with a normal and their sum add less than 20 times this error. The sides of a box add at most the
// same amount.
constexpr double kErrorBound = 0x1p-44;

}  // namespace

SupportTree::SupportTree(const std::vector<HullPoint>& points, std::size_t queries)
    : points_(points), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  const bool few = queries <= kFewQueries;
  build(0, static_cast<std::uint32_t>(points.size()), few ? points.size() : kLeafPoints);
}

double SupportTree::Node::projection_bound(const Eigen::Vector3d& normal) const {
  const Eigen::Vector3d along(dot3(axes.col(0), normal), dot3(axes.col(1), normal),
                              dot3(axes.col(2), normal));
  return dot3(normal, center) + dot3(along.cwiseAbs(), half) + kErrorBound;
}

// Returns the axes of the box of some points. The first two axes span the plane of three points: the first
// point, the point farthest from it, and the point farthest from the line through these two. In this plane
// the sides are those of the smallest rectangle around the points. If a side were along that line instead,
// the box of a square patch would be too wide by a third. For a flat helix of 100 000 points, the query of
// each facet on top would then visit half of the nodes, which takes 15 s in total.
Eigen::Matrix3d SupportTree::sides(std::uint32_t begin, std::uint32_t end) const {
  const auto from_start = [&](std::uint32_t i) -> Eigen::Vector3d {
    return point(i).local - point(begin).local;
  };
  const auto farthest = [&](const Eigen::Vector3d& axis) {
    Eigen::Vector3d found = Eigen::Vector3d::Zero();
    for (std::uint32_t i = begin; i < end; ++i) {
      const Eigen::Vector3d across = from_start(i) - dot3(from_start(i), axis) * axis;
      if (dot3(across, across) > dot3(found, found)) found = across;
    }
    return found;
  };
  const auto negligible = [](const Eigen::Vector3d& q) { return !(dot3(q, q) > 0x1p-80); };
  const Eigen::Vector3d first = farthest(Eigen::Vector3d::Zero());
  if (negligible(first)) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d u = unit3(first), second = farthest(u);
  Eigen::Vector3d v = negligible(second) ? PlaneBasis(u).u : unit3(second);
  v = unit3(v - dot3(v, u) * u);
  // For at most kFew points a rectangle takes more time than it saves. The hull of 300 points of a Gaussian
  // takes 213 us without rectangles and 253 us with them.
  constexpr std::uint32_t kFew = 500;
  Eigen::Vector2d side = Eigen::Vector2d::UnitX();
  if (end - begin > kFew) {
    std::vector<Eigen::Vector2d> flat;
    for (std::uint32_t i = begin; i < end; ++i)
      flat.emplace_back(dot3(u, from_start(i)), dot3(v, from_start(i)));
    side = smallest_rectangle(flat.data(), to_convex_chain(flat.data(), flat.size())).side;
  }
  Eigen::Matrix3d axes;
  axes << side.x() * u + side.y() * v, side.x() * v - side.y() * u, cross3(u, v);
  return axes;
}

SupportTree::Node SupportTree::box(std::uint32_t begin, std::uint32_t end) const {
  const Eigen::Matrix3d axes = sides(begin, end);
  const Eigen::Vector3d start = point(begin).local;
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Eigen::Vector3d q = point(i).local - start;
    const Eigen::Vector3d along(dot3(axes.col(0), q), dot3(axes.col(1), q), dot3(axes.col(2), q));
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  const Eigen::Vector3d middle = (low + high) / 2;
  const Eigen::Vector3d center =
      start + ((middle.x() * axes.col(0) + middle.y() * axes.col(1)) + middle.z() * axes.col(2));
  return {axes, center, (high - low) / 2, begin, end, 0};
}

void SupportTree::build(std::uint32_t begin, std::uint32_t end, std::size_t leaf_points) {
  const std::size_t node = nodes_.size();
  nodes_.push_back(box(begin, end));
  if (end - begin <= leaf_points) return;
  Eigen::Index longest = 0;
  nodes_[node].half.maxCoeff(&longest);
  const Eigen::Vector3d axis = nodes_[node].axes.col(longest);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = dot3(axis, points_[a].local), y = dot3(axis, points_[b].local);
                     return x != y ? x < y : a < b;
                   });
  build(begin, middle, leaf_points);
  nodes_[node].second = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end, leaf_points);
}

// Returns the maximum rounded projection of the points below node n, or `known` if `known` is larger.
double SupportTree::greatest(const Eigen::Vector3d& normal, double known, std::uint32_t n) const {
  const Node& node = nodes_[n];
  if (node.projection_bound(normal) < known) return known;
  if (node.second == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      known = std::max(known, dot3(normal, point(i).local));
    return known;
  }
  const std::uint32_t first = n + 1;
  const bool prefer_second = dot3(normal, nodes_[node.second].center) > dot3(normal, nodes_[first].center);
  known = greatest(normal, known, prefer_second ? node.second : first);
  return greatest(normal, known, prefer_second ? first : node.second);
}

// Considers the points below node n with a rounded projection of at least `least`. If the largest exact
// projection of these points, rounded up, is above `projection`, sets `projection` to it.
void SupportTree::max_projection_up(const Eigen::Vector3d& normal, double least, std::uint32_t n,
                                    double& projection) const {
  const Node& node = nodes_[n];
  if (node.projection_bound(normal) < least) return;
  if (node.second != 0) {
    max_projection_up(normal, least, n + 1, projection);
    max_projection_up(normal, least, node.second, projection);
    return;
  }
  const Direction direction{normal.x(), normal.y(), normal.z()};
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    if (dot3(normal, point(i).local) < least) continue;
    const Coordinates& p = point(i).point;
    const double x = normal.x() * p.x, y = normal.y() * p.y, z = normal.z() * p.z;
    const double error_bound = 0x1p-50 * (std::abs(x) + std::abs(y) + std::abs(z)) + kSmallestNormal;
    if (((x + y) + z) + error_bound <= projection) continue;
    projection = std::max(projection, project_up(direction, p));
  }
}

double SupportTree::max_projection_up(const Eigen::Vector3d& normal) const {
  const double known = greatest(normal, -kInfinity, 0);
  double projection = -kInfinity;
  max_projection_up(normal, known - 2 * kErrorBound, 0, projection);
  return projection;
}

}  // namespace pcl_bv::detail
