// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Convex bodies for the GJK search (gjk.h). The search finds directions from support points in plain double.
// The result is computed from proven upper bounds of the support values along these directions.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::detail {

/// A lower bound of a distance. If `is_exact`, `bound` is the distance up to rounding, and is 0 only if the
/// distance is 0.
struct Gap {
  double bound;
  bool is_exact;
};

/// A body that consists of a convex core and all points within `radius` of the core. Points q of the core are
/// relative to `origin`, a point near the core.
class SupportShape {
 public:
  virtual ~SupportShape() = default;

  /// Returns a point of the core that is farthest along the direction, up to rounding.
  virtual Eigen::Vector3d support(const Eigen::Vector3d& direction) const = 0;

  /// Returns a proven upper bound of direction . q over all points q of the core. The length of the direction
  /// must be about 1.
  virtual double support_value_up(const Eigen::Vector3d& direction) const = 0;

  /// Returns a lower bound of the distance to another shape of the same kind, from pairs of parallel faces.
  /// Both shapes must be at their original pose.
  virtual Gap parallel_gap(const SupportShape&) const { return {0, false}; }

  /// Returns numbers that distinguish shapes of the same kind. lower_bound() uses them to order the two
  /// shapes of a pair.
  virtual Eigen::Vector3d order_key() const = 0;

  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double size = 0;    ///< Upper bound of |q| over the core. Infinite if no bound is known.
  double radius = 0;  ///< Distance from the core to the surface of the body.
  int kind = 0;       ///< index() of the AnyVolume.
};

/// Returns the shape of a volume. Null for an empty volume, and for a k-DOP whose slabs are proven to have no
/// point in common.
std::shared_ptr<SupportShape> make_shape(const AnyVolume& volume);

std::shared_ptr<SupportShape> make_polytope(const Kdop& kdop);
std::shared_ptr<SupportShape> make_polytope(const Hull& hull);
std::shared_ptr<SupportShape> make_polytope(const Prism& prism);

/// Returns a box that contains every point of the core, from the support values along the coordinate axes.
/// The size of the shape must be finite.
Aabb box_of(const SupportShape& shape);

/// Returns sqrt(x^2 + y^2 + z^2) with a relative error of at most 4 * 2^-53, in the whole range of double.
double length3(const Eigen::Vector3d& v);

}  // namespace pcl_bv::detail
