// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Branch and bound in rounded local coordinates; what is within their error of the greatest is decided
// exactly.

#include "reach_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "across.h"
#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/numeric/exact_dot.h"
#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv {
namespace {

constexpr std::size_t kLeafPoints = 8;
constexpr std::size_t kFewQuestions = 64;

// Local coordinates are at most 2, off by 4 2^-53 each; a product with a normal and the sum of three add less
// than 20 times that, box sides the same once more.
constexpr double kDoubt = 0x1p-44;

}  // namespace

ReachTree::ReachTree(const std::vector<HullPoint>& points, std::size_t questions)
    : points_(points), order_(points.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  const bool few = questions <= kFewQuestions;
  build(0, static_cast<std::uint32_t>(points.size()), few ? points.size() : kLeafPoints);
}

double ReachTree::Node::reach(const Eigen::Vector3d& normal) const {
  const Eigen::Vector3d along(dot3(axes.col(0), normal), dot3(axes.col(1), normal),
                              dot3(axes.col(2), normal));
  return dot3(normal, center) + dot3(along.cwiseAbs(), half) + kDoubt;
}

// The first axis goes to the farthest point, the second to the one farthest from that line.
ReachTree::Node ReachTree::box(std::uint32_t begin, std::uint32_t end) const {
  const Eigen::Vector3d start = point(begin).local;
  const auto farthest = [&](const Eigen::Vector3d& axis) {
    Eigen::Vector3d found = Eigen::Vector3d::Zero();
    for (std::uint32_t i = begin; i < end; ++i) {
      const Eigen::Vector3d q = point(i).local - start;
      const Eigen::Vector3d across = q - dot3(q, axis) * axis;
      if (dot3(across, across) > dot3(found, found)) found = across;
    }
    return found;
  };
  Node node{Eigen::Matrix3d::Identity(), start, Eigen::Vector3d::Zero(), begin, end, 0};
  const Eigen::Vector3d first = farthest(Eigen::Vector3d::Zero());
  if (!(dot3(first, first) > 0x1p-80)) {
    node.half.setConstant(0x1p-38);  // all are nearer than 2^-40: upright will do
    return node;
  }
  node.axes.col(0) = unit3(first);
  const Across across(node.axes.col(0));
  const Eigen::Vector3d second = farthest(node.axes.col(0));
  Eigen::Vector3d v = across.u;
  if (dot3(second, second) > 0x1p-80) v = unit3(second);
  v = unit3(v - dot3(v, node.axes.col(0)) * node.axes.col(0));
  node.axes.col(1) = v;
  node.axes.col(2) = cross3(node.axes.col(0), v);
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Eigen::Vector3d q = point(i).local - start;
    const Eigen::Vector3d seen(dot3(node.axes.col(0), q), dot3(node.axes.col(1), q),
                               dot3(node.axes.col(2), q));
    low = low.cwiseMin(seen);
    high = high.cwiseMax(seen);
  }
  const Eigen::Vector3d middle = (low + high) / 2;
  node.half = (high - low) / 2;
  node.center += (middle.x() * node.axes.col(0) + middle.y() * v) + middle.z() * node.axes.col(2);
  return node;
}

void ReachTree::build(std::uint32_t begin, std::uint32_t end, std::size_t leaf_points) {
  const std::size_t node = nodes_.size();
  nodes_.push_back(box(begin, end));
  if (end - begin <= leaf_points) return;
  const Eigen::Vector3d axis = nodes_[node].axes.col(0);
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

// The greatest rounded projection, if it is above what is known.
double ReachTree::greatest(const Eigen::Vector3d& normal, double known, std::uint32_t n) const {
  const Node& node = nodes_[n];
  if (node.reach(normal) < known) return known;
  if (node.second == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      known = std::max(known, dot3(normal, point(i).local));
    return known;
  }
  const std::uint32_t first = n + 1;
  const bool second_reaches = dot3(normal, nodes_[node.second].center) > dot3(normal, nodes_[first].center);
  known = greatest(normal, known, second_reaches ? node.second : first);
  return greatest(normal, known, second_reaches ? first : node.second);
}

void ReachTree::reach_up(const Eigen::Vector3d& normal, double least, std::uint32_t n, double& reach) const {
  const Node& node = nodes_[n];
  if (node.reach(normal) < least) return;
  if (node.second != 0) {
    reach_up(normal, least, n + 1, reach);
    reach_up(normal, least, node.second, reach);
    return;
  }
  const Direction direction{normal.x(), normal.y(), normal.z()};
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    if (dot3(normal, point(i).local) < least) continue;
    const Coordinates& p = point(i).point;
    const double x = normal.x() * p.x, y = normal.y() * p.y, z = normal.z() * p.z;
    const double doubt = 0x1p-50 * (std::abs(x) + std::abs(y) + std::abs(z)) + kSmallestNormal;
    if (((x + y) + z) + doubt <= reach) continue;
    reach = std::max(reach, project_up(direction, p));
  }
}

double ReachTree::reach_up(const Eigen::Vector3d& normal) const {
  const double known = greatest(normal, -kInfinity, 0);
  double reach = -kInfinity;
  reach_up(normal, known - 2 * kDoubt, 0, reach);
  return reach;
}

}  // namespace pcl_bv
