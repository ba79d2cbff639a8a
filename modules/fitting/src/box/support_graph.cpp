// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/support_graph.h"

#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/vector3.h"

namespace pcl_bv::detail {

SupportGraph::SupportGraph(const Silhouette& shape)
    : vertices_(shape.vertices()), first_(vertices_.size() + 1), neighbours_(2 * shape.edges().size()) {
  near_.fill({kNone, kNone});
  for (const Silhouette::Edge& edge : shape.edges()) {
    ++first_[static_cast<std::size_t>(edge.from)];
    ++first_[static_cast<std::size_t>(edge.to)];
  }
  std::int32_t end = 0;
  for (std::int32_t& first : first_)
    first = end += first;
  const auto add = [&](std::int32_t to, std::int32_t neighbour) {
    neighbours_[static_cast<std::size_t>(--first_[static_cast<std::size_t>(to)])] = neighbour;
  };
  for (const Silhouette::Edge& edge : shape.edges()) {
    add(edge.from, edge.to);
    add(edge.to, edge.from);
  }
}

std::int32_t SupportGraph::climb(std::int32_t from, const Eigen::Vector3d& direction) const {
  const double x = direction[0], y = direction[1], z = direction[2];
  const auto along = [&](std::int32_t i) {
    const Eigen::Vector3d& p = vertices_[static_cast<std::size_t>(i)];
    return (p[0] * x + p[1] * y) + p[2] * z;
  };
  double most = along(from);
  for (;;) {
    const std::int32_t at = from;
    const auto i = static_cast<std::size_t>(at);
    for (std::int32_t k = first_[i]; k < first_[i + 1]; ++k) {
      const std::int32_t next = neighbours_[static_cast<std::size_t>(k)];
      const double projection = along(next);
      if (!(projection > most)) continue;
      most = projection;
      from = next;
    }
    if (from == at) return at;
  }
}

SupportGraph::LowHigh SupportGraph::approximate_supports(const Eigen::Vector3d& direction) {
  const double x = std::abs(direction[0]), y = std::abs(direction[1]), z = std::abs(direction[2]);
  const int axis = x >= y && x >= z ? 0 : (y >= z ? 1 : 2);
  const int second = (axis + 1) % 3, third = (axis + 2) % 3;
  const double major = direction[axis];
  const double half = 0.5 * kCells, scale = half / major;  // opposite directions share a cell
  if (!std::isfinite(scale)) return {0, 0};
  const auto number = [&](int minor) {
    const double position = direction[minor] * scale + half;
    return position > 0 ? static_cast<int>(std::min(position, kCells - 1.0)) : 0;
  };
  const int u = number(second), v = number(third);
  const int cell = (axis * kCells + u) * kCells + v;
  LowHigh& found = near_[static_cast<std::size_t>(cell)];
  if (found.low == kNone) {
    Eigen::Vector3d middle;
    middle[axis] = 1;
    middle[second] = (u + 0.5) / half - 1;
    middle[third] = (v + 0.5) / half - 1;
    found = {climb(0, -middle), climb(0, middle)};
  }
  return major > 0 ? found : LowHigh{found.high, found.low};
}

std::array<std::int32_t, 6> SupportGraph::exact_supports(const Eigen::Matrix3d& axes) const {
  std::array<std::int32_t, 6> supports{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto before = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return dot3(axes.col(static_cast<int>(i)), a) < dot3(axes.col(static_cast<int>(i)), b);
    };
    const auto [low, high] = std::minmax_element(vertices_.begin(), vertices_.end(), before);
    supports[2 * i] = static_cast<std::int32_t>(low - vertices_.begin());
    supports[2 * i + 1] = static_cast<std::int32_t>(high - vertices_.begin());
  }
  return supports;
}

}  // namespace pcl_bv::detail
