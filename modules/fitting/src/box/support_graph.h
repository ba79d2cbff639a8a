// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "box/silhouette.h"

namespace pcl_bv {

/// The vertices of a hull and the edges between them, to find which vertex is farthest along a direction.
class SupportGraph {
 public:
  explicit SupportGraph(const Silhouette& shape);

  struct LowHigh {
    std::int32_t low, high;
  };

  /// The vertices farthest back and farthest along the middle of the direction's cell, one of 384 on the
  /// faces of a cube, found when it is first wanted: nearly the farthest. Any two for a zero vector.
  LowHigh near_ends(const Eigen::Vector3d& direction);

  /// The vertices farthest back and farthest along the direction, as climb() finds them.
  LowHigh ends(const Eigen::Vector3d& direction) {
    const auto [low, high] = near_ends(direction);
    return {climb(low, -direction), climb(high, direction)};
  }

  /// The end of a climb from a vertex along edges that go up: the vertex farthest along the direction, unless
  /// rounding hides the way on, as it does among vertices in one line.
  std::int32_t climb(std::int32_t from, const Eigen::Vector3d& direction) const;

  /// The vertices farthest back and farthest along each column, by a pass over all.
  std::array<std::int32_t, 6> all_ends(const Eigen::Matrix3d& axes) const;

 private:
  static constexpr int kCells = 8;  // along each side of the cube
  static constexpr std::int32_t kNone = -1;

  const std::vector<Eigen::Vector3d>& vertices_;
  std::vector<std::int32_t> first_, neighbours_;   // those of vertex i begin at first_[i]
  std::array<LowHigh, 3 * kCells * kCells> near_;  // opposite cells share theirs
};

}  // namespace pcl_bv
