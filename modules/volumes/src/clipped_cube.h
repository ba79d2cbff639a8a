// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The unit cube, cut by half-spaces one after another.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace pcl_bv::volumes_internal {

/// A convex polytope inside the unit cube, as a closed surface of vertex loops. Every cut leaves it closed,
/// whatever rounding does: a cut edge gets one new vertex for both its faces, and the cap is the boundary of
/// what remains. Where it collapses it goes on as a polygon seen from both sides (rank 2), an edge (1) or a
/// vertex (0).
class ClippedCube {
 public:
  using Loop = std::vector<std::int32_t>;

  ClippedCube();

  /// Keeps normal . y <= offset. What is within 2^-42 of the normal's largest component of the plane, plus
  /// the `rounding` of the offset, counts as on it. A normal of 0 cuts nothing.
  void cut(const Eigen::Vector3d& normal, double offset, double rounding = 0);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }  ///< Including those cut away.
  const std::vector<Loop>& loops() const { return loops_; }                   ///< None if nothing is left.
  int rank() const { return rank_; }

 private:
  void collapse();
  void clip();
  Loop clip_loop(const Loop& loop);
  std::int32_t crossing(std::int32_t a, std::int32_t b);
  void close();
  double& height(std::int32_t vertex) { return heights_[vertex]; }

  struct Crossing {
    std::int32_t a, b, vertex;
  };

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Loop> loops_;
  int rank_ = 3;
  // Of the current cut:
  std::vector<double> heights_;  // above the plane, per vertex; exactly 0 for what counts as on it
  std::vector<Crossing> crossings_;
};

}  // namespace pcl_bv::volumes_internal
