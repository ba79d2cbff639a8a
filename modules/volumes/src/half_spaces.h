// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// How far a body of half-spaces reaches: a linear program in three variables, whose dual proves the answer.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace pcl_bv::volumes_internal {

/// Half-spaces n . q <= offset, with q seen from an origin near by, and a box as the last six of them: q_k <=
/// offset for k = 0, 1, 2, then -q_k <= offset. Normals are multiplied by powers of two, to be about 1 long.
class HalfSpaces {
 public:
  static constexpr std::size_t box_sides = 6;

  void reserve(std::size_t count);

  /// normal . (origin + q) <= offset. One of normal 0 is left out, which makes no body smaller.
  void add(const Eigen::Vector3d& normal, double offset, const Eigen::Vector3d& origin);

  /// The last thing to add: finds a box around the body, by exact arithmetic. `guess` is more than half its
  /// width. False if none can be proven: the body may be unbounded.
  bool enclose(double guess);

  /// An upper bound, by exact arithmetic, of direction . q over the body, if there is a box. `vertex` should
  /// be a point of the body that reaches about as far as any.
  double reach_up(const Eigen::Vector3d& direction, const Eigen::Vector3d& vertex) const;

  /// Of the box.
  double radius_up() const;

  std::size_t size() const { return offset_.size(); }
  Eigen::Vector3d normal(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  double offset(std::size_t i) const { return offset_[i]; }

 private:
  /// direction = sum of weights[k] n(sides[k]), weights >= 0, but for rounding.
  struct Basis {
    std::array<std::size_t, 3> sides;
    Eigen::Vector3d weights;
  };

  /// What a basis proves: direction . q <= reach + residual . |q|, the latter by component.
  struct Proof {
    double reach;
    Eigen::Vector3d residual;
  };

  class DualSimplex;

  Basis start(const Eigen::Vector3d& direction) const;
  Proof prove(const Basis& basis, const Eigen::Vector3d& direction, std::size_t usable) const;
  double bound(const Basis& basis, const Eigen::Vector3d& direction) const;

  std::vector<double> x_, y_, z_, offset_;
  Eigen::Vector3d widest_ = Eigen::Vector3d::Zero();  // of the box, by component
};

}  // namespace pcl_bv::volumes_internal
