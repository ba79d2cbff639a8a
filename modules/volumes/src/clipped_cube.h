// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clips the unit cube by half-spaces, one after another.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace pcl_bv::detail {

/// A convex polytope inside the unit cube, as a closed surface of vertex loops. In spite of rounding, the
/// surface stays closed after every cut. The two faces of a cut edge share its new vertex. The new face on
/// the plane, the cap, consists of edges of the remaining faces. A polytope that collapses becomes a polygon
/// with two sides (rank 2), an edge (rank 1) or a vertex (rank 0).
class ClippedCube {
 public:
  using Loop = std::vector<std::int32_t>;

  ClippedCube();

  /// Cuts off the points y with normal . y > offset. A vertex is treated as on the plane if |normal . y -
  /// offset| is at most 2^-42 of the normal's largest component plus `rounding`. `rounding` is the error
  /// bound of the offset. A normal of 0 cuts nothing.
  void cut(const Eigen::Vector3d& normal, double offset, double rounding = 0);

  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }  ///< Includes removed vertices.
  const std::vector<Loop>& loops() const { return loops_; }                   ///< Empty if all was cut off.
  int rank() const { return rank_; }

 private:
  void collapse();
  void clip();
  Loop clip_loop(const Loop& loop);
  std::int32_t crossing(std::int32_t a, std::int32_t b);
  void close();
  double& height(std::int32_t vertex) { return heights_[vertex]; }

  struct Crossing {  // the new vertex on the edge from a to b
    std::int32_t a, b, vertex;
  };

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Loop> loops_;
  int rank_ = 3;
  // State of the current call of cut():
  std::vector<double> heights_;  // height of each vertex above the plane; exactly 0 if treated as on it
  std::vector<Crossing> crossings_;
};

}  // namespace pcl_bv::detail
