// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Certified overlap tests and distances of two volumes of any kinds.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>

#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
class SupportShape;
struct PosedShape;
}  // namespace detail

/// A volume that is prepared for many overlap and distance queries, as in trees of volumes and collision
/// loops. The corners of a k-DOP are computed only once. The half-spaces of a k-DOP or hull are converted
/// only once to coordinates relative to a point near the volume.
///
/// A body is cheap to copy. Copies and transformed bodies share the prepared data, which never changes, so
/// several threads may use bodies at the same time. Construction takes 35 us for a 26-DOP, 25 us for a hull
/// of 100 vertices and 0.03 to 0.2 us for the other kinds.
class ConvexBody {
 public:
  /// Makes the empty body, which overlaps nothing.
  ConvexBody();

  /// Prepares the volume.
  explicit ConvexBody(const AnyVolume& volume);

  /// Returns whether the body has no point.
  bool empty() const { return !shape_; }

  /// Returns the body moved by `transform`. The result contains the exact value of `transform * p` for every
  /// point p of this body. The result may be larger than the set of these values, by the rounding errors of
  /// the coordinates. If the linear part of `transform` is not exactly a rotation, the radius of a round body
  /// also grows: it is multiplied by an upper bound of the matrix norm. A call takes 1.5 us for every kind of
  /// volume.
  ///
  /// Rounding errors of successive calls add up. A loop should therefore transform the original body each
  /// time, not the body of the previous step.
  ConvexBody transformed(const Eigen::Isometry3d& transform) const;

 private:
  friend detail::PosedShape;

  // The body consists of all points within radius_ of the points `origin_ + rotation_ * q`, where q is any
  // point of the shape's core.
  std::shared_ptr<const detail::SupportShape> shape_;  // null if empty
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d origin_;
  double radius_, size_;  // size_ is an upper bound of |rotation_ q|
  bool is_rotated_;       // false: rotation_ is the identity
};

/// Returns whether two volumes have a point in common. Each volume is the set that its class defines. The
/// test is conservative. If the result is false, the volumes are proven to be separated along some direction.
/// If the result is true, the distance of the volumes is at most about 1e-14 * (sum of their sizes + distance
/// of their centres).
///
/// False if either volume is empty. The order of the arguments does not matter. Two Aabb are compared
/// exactly. Two Kdop of equal sets are compared exactly along their directions. A Hull whose planes leave it
/// unbounded overlaps every volume that is not empty.
///
/// The algorithm of Gilbert, Johnson and Keerthi (1988) proposes the directions; see docs/numerics.md. A call
/// for two ConvexBody takes 0.1 to 0.2 us. A call takes 0.7 to 1.5 us if one of the bodies is a 26-DOP, and
/// 1.5 to 4 us if one is a hull of 100 vertices. distance() takes two to three times as long as overlaps(),
/// and at most 4 us for round bodies.
bool overlaps(const AnyVolume& a, const AnyVolume& b);
bool overlaps(const ConvexBody& a, const ConvexBody& b);

/// Returns a certified lower bound of the distance of two volumes, in their unit: no point of one volume is
/// nearer than this bound to any point of the other volume. The bound is below the distance by at most about
/// 1e-12 of the distance plus 1e-13 of the sizes. The bound is 0 if and only if overlaps() is true. Returns
/// infinity if either volume is empty. The order of the arguments does not matter.
double distance(const AnyVolume& a, const AnyVolume& b);
double distance(const ConvexBody& a, const ConvexBody& b);

/// Returns a certified lower bound of the distance from the point to the body. NaN if the point has a NaN
/// coordinate, otherwise infinity if the body is empty or the point has an infinite coordinate.
double distance(const ConvexBody& body, const Eigen::Vector3d& point);

/// Returns whether distance(a, b) <= margin. Conservative: true for all bodies whose exact distance is at
/// most `margin`. Faster than distance(), because the search stops as soon as the answer is known. If either
/// body is empty, the result is true only for a margin of infinity. If neither is empty, the result is true
/// for a margin of NaN.
bool within(const ConvexBody& a, const ConvexBody& b, double margin);

}  // namespace pcl_bv
