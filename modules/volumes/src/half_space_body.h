// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Upper bounds of the support value of a body that is given by half-spaces, with a proof in floating point.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "dual_simplex.h"

namespace pcl_bv::detail {

/// A body given by half-spaces n . q <= offset, where q is relative to a nearby origin. After add_box(), the
/// last six half-spaces are an axis-aligned box around the body, in the order q_k <= offset for k = 0, 1, 2,
/// then -q_k <= offset. Normals are multiplied by powers of two, so that their length is about 1.
class HalfSpaceBody {
 public:
  static constexpr std::size_t box_sides = 6;

  void reserve(std::size_t count);

  /// Adds the half-space normal . (origin + q) <= offset. Ignores half-spaces with a zero normal or an offset
  /// that overflows, which never makes the body smaller.
  void add(const Eigen::Vector3d& normal, double offset, const Eigen::Vector3d& origin);

  /// Adds a box that contains every point of the body, in spite of rounding errors. Must be called once,
  /// after the last add(). `guess` must exceed half the width of the body. Returns false if no box can be
  /// proven, because the body may be unbounded.
  bool add_box(double guess);

  /// Returns a proven upper bound of direction . q over the body. Requires that add_box() has returned true.
  /// `vertex` should be a point of the body whose projection on `direction` is about the largest. With any
  /// other point, the bound is still valid, but less tight, and the function is slower.
  double support_value_up(const Eigen::Vector3d& direction, const Eigen::Vector3d& vertex) const;

  /// Returns an upper bound of |q| over the box.
  double radius_up() const;

 private:
  /// The bound that a basis proves: direction . q <= bound + residual . |q|, where |q| is the vector of the
  /// magnitudes of q's components.
  struct DualBound {
    double bound;
    Eigen::Vector3d residual;
  };

  std::size_t size() const { return offsets_.size(); }

  /// Returns the basis of the box.
  DualBasis start(const DualSimplex& simplex) const {
    const std::size_t first = size() - box_sides;
    return simplex.start({first, first + 1, first + 2}, box_sides / 2);
  }
  DualBound prove(const DualBasis& basis, const Eigen::Vector3d& direction, std::size_t usable) const;
  double bound(const DualBasis& basis, const Eigen::Vector3d& direction) const;

  Normals normals_;
  std::vector<double> offsets_;
  Eigen::Vector3d max_abs_ = Eigen::Vector3d::Zero();  // largest |q_k| in the box, by component
};

}  // namespace pcl_bv::detail
