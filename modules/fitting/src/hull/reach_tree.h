// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far a set of points reaches along any direction, exactly, without looking at most of them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "hull/local_hull.h"

namespace pcl_bv {

/// A tree of boxes over points, each turned as its points lie: on a smooth surface upright ones would stick
/// out so far that hundreds of points were looked at for each question, not tens.
class ReachTree {
 public:
  /// Keeps the points, for about so many questions: few of them are not worth a tree. O(m log m).
  ReachTree(const std::vector<HullPoint>& points, std::size_t questions);

  /// The least double that is not below the exact normal . p for any of the points as they are stored.
  /// Components of the normal up to 2 in magnitude. O(log m) where few points reach equally far.
  double reach_up(const Eigen::Vector3d& normal) const;

 private:
  struct Node {
    Eigen::Matrix3d axes;
    Eigen::Vector3d center, half;  // of a box around the local coordinates
    std::uint32_t begin, end;      // of its points in order_
    std::uint32_t second;          // the second child; the first follows its parent; 0: a leaf

    double reach(const Eigen::Vector3d& normal) const;
  };

  Eigen::Matrix3d sides(std::uint32_t begin, std::uint32_t end) const;
  Node box(std::uint32_t begin, std::uint32_t end) const;

  void build(std::uint32_t begin, std::uint32_t end, std::size_t leaf_points);
  double greatest(const Eigen::Vector3d& normal, double known, std::uint32_t node) const;
  void reach_up(const Eigen::Vector3d& normal, double least, std::uint32_t node, double& reach) const;
  const HullPoint& point(std::uint32_t i) const { return points_[order_[i]]; }

  const std::vector<HullPoint>& points_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace pcl_bv
