// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The half-planes of a prism's outline, with the rounding errors of tests against them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "pcl_bv/numeric/constants.h"
#include "pcl_bv/volumes/prism.h"
#include "projection.h"

namespace pcl_bv::detail {

/// A value that is linear along an edge's normal: positive inside the edge's half-plane. `error` bounds the
/// rounding error of `value`.
struct SideValue {
  double value, error;
};

/// The edges of an outline. Edges of tiny outlines are multiplied by a power of two, so that their products
/// do not underflow.
class PrismSides {
 public:
  explicit PrismSides(const Prism& prism) : outline_(prism.outline()), low_(outline_[0]), high_(outline_[0]) {
    for (const Eigen::Vector2d& corner : outline_) {
      low_ = low_.cwiseMin(corner);
      high_ = high_.cwiseMax(corner);
    }
    if ((high_ - low_).maxCoeff() < 0x1p-300) unit_ = 0x1p600;
  }

  /// Calls visit(corner, edge) for each edge; `edge` is the rounded difference of its corners times a power
  /// of two.
  template <typename Visit>
  bool all_of(const Visit& visit) const {
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      if (!visit(outline_[i], edge(i))) return false;
    }
    return true;
  }

  /// Returns the corner after the corner i.
  const Eigen::Vector2d& next(std::size_t i) const { return outline_[i + 1 < outline_.size() ? i + 1 : 0]; }

  /// Returns the edge that begins at the corner i, multiplied by the power of two.
  Eigen::Vector2d edge(std::size_t i) const { return (next(i) - outline_[i]) * unit_; }

  const std::vector<Eigen::Vector2d>& outline() const { return outline_; }

  /// Returns the cross product edge x (u, v). The rounding errors of edge, u, v, two products and their
  /// difference are at most 4.01 * 2^-53 of the products' magnitudes. The bound is 8 * 2^-53 of these, and
  /// also covers the errors `u.error` and `v.error`.
  static SideValue cross(const Eigen::Vector2d& edge, const Projection& u, const Projection& v) {
    const double left = edge.x() * v.value, right = edge.y() * u.value;
    const double widened = std::abs(edge.x()) * v.error + std::abs(edge.y()) * u.error;
    return {left - right,
            widened * (1 + 0x1p-50) + 0x1p-50 * (std::abs(left) + std::abs(right)) + kSmallestNormal};
  }

  /// The box of the outline. The half-planes of one or two corners do not bound the outline, but the box
  /// does. Where a corner is sharp, the box also limits how far beyond it points are treated as inside.
  const Eigen::Vector2d& low() const { return low_; }
  const Eigen::Vector2d& high() const { return high_; }

 private:
  const std::vector<Eigen::Vector2d>& outline_;
  Eigen::Vector2d low_, high_;
  double unit_ = 1;
};

/// Returns a projection relative to a coordinate. The rounding of the difference is covered by cross().
inline Projection relative(const Projection& p, double from) {
  return {p.value - from, p.error};
}

}  // namespace pcl_bv::detail
