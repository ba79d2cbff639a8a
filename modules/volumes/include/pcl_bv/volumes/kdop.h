// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// k-DOPs and their sets of directions.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/geometry.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// An immutable list of the directions of a k-DOP, one per slab. k is twice the number of directions.
/// Directions may have any length. The built-in directions have components 0 and +-1 and are not normalised,
/// so that projections need no multiplication. See Klosowski et al. 1998 and Karlsson, Winberg and Larsson
/// 2010, section 2.
class KdopSet {
 public:
  static constexpr std::size_t min_size = 3;
  static constexpr std::size_t max_size = 49;

  /// Makes a set of your own directions. Throws std::invalid_argument unless there are 3 to 49 directions,
  /// all finite, each with a largest component from 1e-30 to 1e30 in magnitude. Also throws unless the
  /// directions span space, that is, unless three of them, normalised, have a determinant of at least 1e-6 in
  /// magnitude.
  explicit KdopSet(std::vector<Eigen::Vector3d> directions);

  /// The built-in sets. dop26() has these 13 directions, in this order:
  /// (1,0,0) (0,1,0) (0,0,1), (1,1,1) (1,1,-1) (1,-1,1) (1,-1,-1),
  /// (1,1,0) (1,-1,0) (1,0,1) (1,0,-1) (0,1,1) (0,1,-1).
  /// dop6() has the first 3, dop14() the first 7, and dop18() the first 3 and the last 6. The pointers own
  /// nothing, so copying a pointer changes no atomic reference count.
  static const std::shared_ptr<const KdopSet>& dop6();
  static const std::shared_ptr<const KdopSet>& dop14();
  static const std::shared_ptr<const KdopSet>& dop18();
  static const std::shared_ptr<const KdopSet>& dop26();

  std::size_t size() const { return directions_.size(); }  ///< Number of directions: half of k.
  const Eigen::Vector3d& direction(std::size_t i) const { return directions_[i]; }  ///< Not normalised.

  /// Returns the indices of three linearly independent, well-conditioned directions. In the built-in sets,
  /// they are 0, 1 and 2.
  const std::array<std::size_t, 3>& basis() const { return basis_; }

 private:
  std::vector<Eigen::Vector3d> directions_;
  std::array<std::size_t, 3> basis_;
};

/// Returns whether both sets have the same directions in the same order.
bool operator==(const KdopSet& a, const KdopSet& b);
inline bool operator!=(const KdopSet& a, const KdopSet& b) {
  return !(a == b);
}

/// One number per slab, stored inline without an allocation.
using SlabVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, static_cast<int>(KdopSet::max_size), 1>;

/// A view of the numbers that a Kdop stores. Valid until the Kdop is destroyed or assigned to.
using SlabView = Eigen::Map<const SlabVector>;

/// A float copy of a Kdop whose slabs are rounded outward. A bound beyond the range of float becomes the
/// largest finite float or infinity.
struct FloatKdop {
  std::shared_ptr<const KdopSet> set;
  Eigen::Matrix<float, Eigen::Dynamic, 1, 0, static_cast<int>(KdopSet::max_size), 1> min;
  Eigen::Matrix<float, Eigen::Dynamic, 1, 0, static_cast<int>(KdopSet::max_size), 1> max;
};

/// A k-DOP in the frame and unit of its points: the closed convex polytope of all p with min(i) <=
/// direction(i) . p <= max(i) for each slab i. See Karlsson, Winberg and Larsson 2010, section 2.
///
/// The empty k-DOP has min = +infinity and max = -infinity; merging the empty k-DOP into another k-DOP
/// changes nothing. A flat k-DOP is a polygon, a segment or a point, and is a valid volume. Coordinates
/// beyond 1e100 are not supported.
///
/// Slabs that were measured on points always have a point in common. Other slabs may have no point in common
/// although min <= max for each of them. Such a k-DOP has volume 0 and no corners, although empty() is false.
/// tightened() turns such a k-DOP into the empty k-DOP if the slabs miss each other by more than the
/// tolerances documented there.
///
/// Some member functions need the corners: volume(), surface_area(), center(), corners(), mesh(), and
/// distance() for a point outside. Each call of such a function intersects the half-spaces anew, which takes
/// 20 us for a 26-DOP. The corners are accurate to about 1e-13 of the extent.
class Kdop {
 public:
  /// Makes the empty k-DOP. Throws std::invalid_argument for a null set.
  explicit Kdop(std::shared_ptr<const KdopSet> set = KdopSet::dop26());

  /// Makes a k-DOP from one slab per direction. If any min exceeds its max, the k-DOP is empty. Otherwise
  /// throws std::invalid_argument unless all numbers are finite. Also throws for a null set and for a wrong
  /// number of slabs. Stores -0 as 0.
  Kdop(std::shared_ptr<const KdopSet> set, const SlabVector& min, const SlabVector& max);

  const std::shared_ptr<const KdopSet>& set() const { return set_; }  ///< The directions; never null.
  std::size_t size() const { return set_->size(); }                   ///< Number of slabs: half of k.

  double min(std::size_t i) const { return numbers()[i]; }           ///< Lower bound of slab i.
  double max(std::size_t i) const { return numbers()[size() + i]; }  ///< Upper bound of slab i.

  /// Lower and upper bounds of all slabs. A temporary Kdop returns copies.
  SlabView min() const& { return {numbers(), static_cast<Eigen::Index>(size())}; }
  SlabView max() const& { return {numbers() + size(), static_cast<Eigen::Index>(size())}; }
  SlabVector min() && { return static_cast<const Kdop&>(*this).min(); }
  SlabVector max() && { return static_cast<const Kdop&>(*this).max(); }

  /// Returns the thickness of slab i in the unit of the points, that is, (max - min) / |direction| (Karlsson
  /// et al. 2010, Figure 2, line 13). 0 if empty.
  double width(std::size_t i) const;

  /// Returns whether this is the empty k-DOP, with min > max.
  bool empty() const;

  /// Returns whether the k-DOP contains the point. Conservative: true for every point of the k-DOP, in spite
  /// of rounding errors. False for an empty k-DOP and for a point with a coordinate that is not finite.
  ///
  /// Computed in double, with s = (x nx + y ny) + z nz. The conditions for each slab are s - e <= max and s +
  /// e >= min, where e = 4 * 2^-53 (|x nx| + |y ny| + |z nz|) + 2^-1022 is the error bound.
  bool contains(const Eigen::Vector3d& point) const;

  /// Returns the volume of the polytope in cubed units; 0 if empty or flat.
  double volume() const;

  /// Returns the surface area in squared units. Both sides of a flat k-DOP count. 0 if empty.
  double surface_area() const;

  /// Returns the centre of mass of the polytope or, if it is flat, of the polygon, segment or point. NaN if
  /// empty or if the slabs have no point in common.
  Eigen::Vector3d center() const;

  /// Returns a corner that is farthest along `direction` (any length). NaN if empty. Uses the dual simplex
  /// method, which takes about 1 us.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Returns the distance from the point to the k-DOP; 0 if contains() is true. NaN if the point has a NaN
  /// coordinate, otherwise infinity if the k-DOP is empty or the point has an infinite coordinate.
  double distance(const Eigen::Vector3d& point) const;

  /// Returns the part of the ray `origin + t * direction`, t >= 0, inside the k-DOP; see RayInterval. `enter`
  /// is 0 if contains() is true for the origin. Uses the slab method (Kay, Kajiya 1986), which takes 50 ns
  /// for a 26-DOP.
  ///
  /// The projections of origin and direction are widened by twice the error bound of contains(). So a ray
  /// that misses a face by less than these error bounds may be reported as a hit. Finally, `enter` and `exit`
  /// are moved outward by 2^-51 of their magnitude plus 2^-1022.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Returns whether each slab overlaps the other k-DOP's slab along the same direction, compared exactly.
  /// This is the usual test for k-DOPs (Klosowski et al. 1998). False proves that the k-DOPs have no point in
  /// common. True may be wrong for more than three directions, because another direction can separate the
  /// polytopes. False if either k-DOP is empty. Throws std::invalid_argument unless both have equal sets.
  bool overlaps(const Kdop& other) const;

  /// Returns the same polytope with each slab reduced to the extent of the polytope along its direction.
  /// Slabs that were merged, transformed or set by the caller can be wider than that extent. Slabs that were
  /// measured on points are not. The result contains every point of this k-DOP, in spite of rounding errors.
  /// No slab grows. Slabs are tight to 1e-13 of the extent plus 2^-48 of the coordinates; a second call
  /// changes them by no more than that. A call takes 10 us for a 26-DOP.
  ///
  /// The result is empty if the new min of a slab exceeds its new max, which proves that the polytope has no
  /// point. In all tests, the result was empty if slabs missed each other by more than these tolerances; this
  /// is not proven.
  Kdop tightened() const;

  /// Returns a box that contains every point of the polytope, in spite of rounding errors. If a coordinate
  /// axis is one of the directions, the box has the bounds of that slab along the axis. Along any other axis,
  /// the box has the support values of the polytope, rounded outward.
  Aabb aabb() const;

  /// Returns the vertices of the polytope without duplicates. Returns none if the k-DOP is empty or its slabs
  /// have no point in common.
  std::vector<Eigen::Vector3d> corners() const;

  /// Returns the corners and the faces. A polygon has two faces, one for each side; a segment has one face of
  /// two vertices; a point has no face.
  Mesh mesh() const;

  /// Returns the k-DOP of the transformed polytope along the same directions. The result contains the exact
  /// value of `transform * p` for every point p of this k-DOP. Slabs are tight to a few units in the last
  /// place of the coordinates.
  Kdop transformed(const Eigen::Isometry3d& transform) const;

  /// Enlarges the k-DOP to contain the point. Slabs are extended to the exact projection of the point or, if
  /// the projection is not a double, to the next double outward. A point with a coordinate that is not finite
  /// is ignored.
  Kdop& extend(const Eigen::Vector3d& point);

  /// Enlarges each slab to contain the other k-DOP's slab. The result is exact, so merging is commutative and
  /// associative. Throws std::invalid_argument unless both have equal sets.
  Kdop& merge(const Kdop& other);

  /// Returns a float copy that encloses the k-DOP.
  FloatKdop cast_float() const;

 private:
  // The min of all slabs, then the max of all slabs.
  const double* numbers() const {
    return heap_numbers_.empty() ? inline_numbers_.data() : heap_numbers_.data();
  }
  double* numbers() { return heap_numbers_.empty() ? inline_numbers_.data() : heap_numbers_.data(); }
  void store(const SlabVector& min, const SlabVector& max);

  // Up to 13 slabs (a 26-DOP) are stored inline, without an allocation. With an inline capacity of 49 slabs,
  // every AnyVolume would have more than 800 bytes instead of 256. That is too much for a million clusters.
  static constexpr std::size_t max_inline_slabs = 13;

  std::shared_ptr<const KdopSet> set_;
  std::array<double, 2 * max_inline_slabs> inline_numbers_{};
  std::vector<double> heap_numbers_;  // replaces inline_numbers_ if size() > max_inline_slabs, else empty
};

/// Returns whether the k-DOPs have equal sets of directions and equal slabs.
bool operator==(const Kdop& a, const Kdop& b);
inline bool operator!=(const Kdop& a, const Kdop& b) {
  return !(a == b);
}

}  // namespace pcl_bv
