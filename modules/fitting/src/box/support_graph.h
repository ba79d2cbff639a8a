// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Support vertices of a convex hull along any direction.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "box/silhouette.h"

namespace pcl_bv::detail {

/// The vertices and edges of a hull as a graph, in which the vertex with the maximum projection along a
/// direction is found by climbing.
class SupportGraph {
 public:
  explicit SupportGraph(const Silhouette& shape);

  /// The vertices with the minimum and the maximum projection along a direction.
  struct LowHigh {
    std::int32_t low, high;
  };

  /// The faces of a cube are divided into 384 cells. Returns the vertices with the minimum and the maximum
  /// projection along the middle of the cell that contains `direction`. These vertices are computed when the
  /// cell is first used. For a direction whose components are all below 2^-1021, returns vertex 0 twice. For
  /// any other direction, also one with a NaN, returns some vertices.
  LowHigh approximate_supports(const Eigen::Vector3d& direction);

  /// Returns the vertices with the minimum and the maximum projection along the direction, as climb() finds
  /// them.
  LowHigh support_vertices(const Eigen::Vector3d& direction) {
    const auto [low, high] = approximate_supports(direction);
    return {climb(low, -direction), climb(high, direction)};
  }

  /// Moves from vertex `from` along edges while the projection grows, and returns the last vertex. This is
  /// the vertex with the maximum projection, unless rounding ends the climb early. That can happen among
  /// collinear vertices.
  std::int32_t climb(std::int32_t from, const Eigen::Vector3d& direction) const;

  /// Returns the vertices with the minimum and the maximum projection along each column of `axes`, by a pass
  /// over all vertices.
  std::array<std::int32_t, 6> exact_supports(const Eigen::Matrix3d& axes) const;

 private:
  static constexpr int kCells = 8;  // cells along each side of a face of the cube
  static constexpr std::int32_t kNone = -1;

  const std::vector<Eigen::Vector3d>& vertices_;
  std::vector<std::int32_t> first_, neighbours_;  // the neighbours of vertex i begin at position first_[i]
  // The supports of each cell. Opposite cells share an entry.
  std::array<LowHigh, std::size_t{3} * kCells * kCells> near_;
};

}  // namespace pcl_bv::detail
