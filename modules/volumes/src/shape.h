// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Convex bodies as the search for the nearest points of two sees them: support mappings, in plain double to
// propose with and as proven bounds to answer with.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::volumes_internal {

/// A lower bound of a distance, exact in its sign where `whole`: then it is the distance, to rounding.
struct Gap {
  double bound;
  bool whole;
};

/// A core, seen from an origin near by, and everything within a radius of it.
class Shape {
 public:
  virtual ~Shape() = default;

  /// A point of the core, as far along the direction as there is one, to rounding.
  virtual Eigen::Vector3d support(const Eigen::Vector3d& direction) const = 0;

  /// An upper bound, by exact arithmetic, of direction . q over the points origin + q of the core. The
  /// direction is about as long as 1.
  virtual double reach_up(const Eigen::Vector3d& direction) const = 0;

  /// What faces in common tell of the distance to another of the kind, both standing where they were made.
  virtual Gap parallel_gap(const Shape&) const { return {0, false}; }

  /// Some numbers that tell bodies of one kind apart, for an order of the two in a pair.
  virtual Eigen::Vector3d mark() const = 0;

  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double size = 0;    ///< No q is longer. Infinite: nothing is known of the body.
  double radius = 0;  ///< Around the core.
  int kind = 0;       ///< AnyVolume::index().
};

/// Null for an empty volume, also for slabs that are proven to have no point in common.
std::shared_ptr<Shape> make_shape(const AnyVolume& volume);

std::shared_ptr<Shape> make_polytope(const Kdop& kdop);
std::shared_ptr<Shape> make_polytope(const Hull& hull);

/// sqrt(x^2 + y^2 + z^2) to 4 2^-53 of it, in the whole range of double.
double length3(const Eigen::Vector3d& v);

}  // namespace pcl_bv::volumes_internal
