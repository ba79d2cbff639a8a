// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Whether two volumes of any kinds meet, and how far apart they are: certified, as everything about a volume
// is.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>

#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace volumes_internal {
class Shape;
struct Placed;
}  // namespace volumes_internal

/// A volume made ready to be asked about others: corners of a k-DOP and half-spaces seen from a point near by
/// are found once. For trees of volumes and collision loops. Cheap to copy; copies and moved ones share what
/// was found, so it may be used by several threads.
///
/// Making one costs 0.03 to 0.2 us for most kinds, 35 us for a 26-DOP and 25 us for a hull of 100 vertices.
class ConvexBody {
 public:
  /// The empty body, which meets nothing.
  ConvexBody();

  explicit ConvexBody(const AnyVolume& volume);

  bool empty() const { return !shape_; }

  /// The body moved from where it is: the image of every point of it, by exact arithmetic on the stored
  /// matrices, is in it. It exceeds the image by the rounding of the coordinates, and where the matrix is no
  /// rotation a radius grows by what it stretches. 1.5 us, whatever the kind. Moves add up their rounding: a
  /// loop moves the body that it began with, not the last one.
  ConvexBody moved(const Eigen::Isometry3d& transform) const;

 private:
  friend volumes_internal::Placed;

  std::shared_ptr<const volumes_internal::Shape> shape_;  // null: empty
  Eigen::Matrix3d turn_;                                  // a point q of the shape is at origin_ + turn_ q,
  Eigen::Vector3d origin_;                                // and everything within radius_ of it
  double radius_, size_;                                  // no turn_ q is longer than size_
  bool turned_;
};

/// Whether two volumes have a point in common, by the definitions of their kinds and exact arithmetic. Errs
/// only towards true, and only by rounding: where the answer is false, a direction was found along which the
/// two are proven to be apart; where it is true, they are no farther apart than some 1e-14 of their sizes and
/// of the distance of their centres. Two Aabb are compared exactly, two Kdop of equal sets along their
/// directions, too. The order of the two does not matter. False if either is empty. A Hull is what its planes
/// enclose; planes that leave it unbounded meet everything.
///
/// The algorithm of Gilbert, Johnson and Keerthi (1988) proposes directions; see docs/numerics.md. For pairs
/// that were made ready 0.1 to 0.2 us, with a 26-DOP 0.7 to 1.5 us, with a hull of 100 vertices 1.5 to 4 us;
/// distance() takes two to three times that, and up to 4 us between round ones.
bool overlaps(const AnyVolume& a, const AnyVolume& b);
bool overlaps(const ConvexBody& a, const ConvexBody& b);

/// A certified lower bound of the distance of two volumes in their unit: no two points of them are nearer.
/// Short of the true one by no more than some 1e-12 of it and 1e-13 of the sizes. 0 exactly where overlaps()
/// holds. The order of the two does not matter. Infinity if either is empty.
double distance(const AnyVolume& a, const AnyVolume& b);
double distance(const ConvexBody& a, const ConvexBody& b);

/// Likewise of a point, for bodies that are asked often. NaN for a point with a NaN.
double distance(const ConvexBody& body, const Eigen::Vector3d& point);

/// Whether distance(a, b) <= margin; never false for two that are that near by exact arithmetic. Stops as
/// soon as that is known. True for a margin that is NaN, but for an empty body.
bool within(const ConvexBody& a, const ConvexBody& b, double margin);

}  // namespace pcl_bv
