// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/volumes/aabb.h"
#include "pcl_bv/volumes/kdop_set.h"
#include "pcl_bv/volumes/mesh.h"
#include "pcl_bv/volumes/ray_interval.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// One number per slab, stored inline (no allocation).
using SlabVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, static_cast<int>(KdopSet::max_size), 1>;

/// The numbers that a Kdop stores, seen in place: valid as long as it lives and is not assigned to.
using SlabView = Eigen::Map<const SlabVector>;

/// A copy of a Kdop for float consumers, slabs rounded outward. Beyond the range of float: infinite.
struct FloatKdop {
  std::shared_ptr<const KdopSet> set;
  Eigen::Matrix<float, Eigen::Dynamic, 1, 0, static_cast<int>(KdopSet::max_size), 1> min;
  Eigen::Matrix<float, Eigen::Dynamic, 1, 0, static_cast<int>(KdopSet::max_size), 1> max;
};

/// A k-DOP in the frame and unit of its points: all p with min(i) <= direction(i) . p <= max(i) for each slab
/// i, a closed convex polytope. Karlsson et al. 2010, section 2.
///
/// The empty k-DOP (the identity of merge) has min = +infinity and max = -infinity. Flat ones (a plane, a
/// line, a point) are volumes like any other. Slabs that are each sound but have no point in common are not
/// empty() but have volume 0 and no corners; tightened() makes them so. Slabs measured on points never do
/// that. The verbs that need the corners (volume, surface_area, center, corners, mesh, distance to an outside
/// point) intersect the half-spaces anew at each call, 20 us for a 26-DOP, with the corners good to about
/// 1e-13 of the extent. Coordinates beyond 1e100 are not supported.
class Kdop {
 public:
  /// The empty k-DOP. Throws std::invalid_argument for a null set.
  explicit Kdop(std::shared_ptr<const KdopSet> set = KdopSet::dop26());

  /// Slabs, one per direction. Any min above its max: the empty k-DOP. Otherwise all must be finite. Throws
  /// std::invalid_argument for that, for a null set and for a wrong number of slabs. A -0 is stored as 0.
  Kdop(std::shared_ptr<const KdopSet> set, const SlabVector& min, const SlabVector& max);

  const std::shared_ptr<const KdopSet>& set() const { return set_; }
  std::size_t size() const { return set_->size(); }  ///< Slabs: half of k.

  double min(std::size_t i) const { return numbers()[i]; }
  double max(std::size_t i) const { return numbers()[size() + i]; }
  SlabView min() const& { return {numbers(), static_cast<Eigen::Index>(size())}; }
  SlabView max() const& { return {numbers() + size(), static_cast<Eigen::Index>(size())}; }
  SlabVector min() && { return static_cast<const Kdop&>(*this).min(); }
  SlabVector max() && { return static_cast<const Kdop&>(*this).max(); }

  /// Thickness of slab i in the unit of the points, as for a unit direction (Figure 2, line 13). 0 if empty.
  double width(std::size_t i) const;

  bool empty() const;

  /// For each slab: s = (x nx + y ny) + z nz lies between min and max, give or take the rounding bound
  /// 4 2^-53 (|x nx| + |y ny| + |z nz|) + 2^-1022. So every point inside by exact arithmetic is contained; it
  /// errs only towards true. False for an empty k-DOP and for a point that is not finite.
  bool contains(const Eigen::Vector3d& point) const;

  /// Of the polytope, in cubed units; 0 if empty or flat.
  double volume() const;

  /// In squared units; both sides of a flat k-DOP count. 0 if empty.
  double surface_area() const;

  /// The centre of mass (of the area, the line, the point if flat). NaN if empty.
  Eigen::Vector3d center() const;

  /// A corner farthest along `direction` (any length). NaN if empty. Dual simplex method, about 1 us.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const;

  /// Distance of a point, 0 where contains() holds. Infinity if empty, NaN for a point with a NaN.
  double distance(const Eigen::Vector3d& point) const;

  /// Where the ray origin + t direction is inside, as RayInterval says; where contains() holds for the
  /// origin, enter is 0. Each projection, of origin and direction, is taken to be off by twice the bound of
  /// contains(), so a ray that passes a face by less may hit; then each end is moved outward by 2^-51 of
  /// itself and by 2^-1022. Slab method (Kay, Kajiya 1986), 50 ns for a 26-DOP.
  std::optional<RayInterval> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  /// Whether all slabs overlap those of the other: exact comparison, the usual test for k-DOPs (Klosowski et
  /// al. 1998). False proves that no point is in both. True may be wrong unless there are only three
  /// directions: two polytopes can be apart along another one. False if either is empty. Throws
  /// std::invalid_argument unless both have equal sets.
  bool overlaps(const Kdop& other) const;

  /// The same polytope, each slab moved in to where it reaches: what merging, transforming or a user's
  /// numbers left loose (slabs measured on points are not). Every point of this one is inside by exact
  /// arithmetic and no slab grows; slabs are tight, and unchanged by a second call, to 1e-13 of the extent
  /// and 2^-48 of the coordinates. Empty if two bounds cross, which proves that there is no point; that they
  /// do wherever slabs miss each other by more than that margin is tested, not proven. 10 us for a 26-DOP.
  Kdop tightened() const;

  /// A box around the polytope, by exact arithmetic: along an axis that is one of the directions the slab
  /// itself, else the support along the axis rounded outward.
  Aabb aabb() const;

  /// The vertices of the polytope, none twice; at least one unless empty.
  std::vector<Eigen::Vector3d> corners() const;

  /// The corners, with the faces that have some extent. A flat k-DOP is one polygon seen from both sides; a
  /// line is a face of two vertices, a point has none.
  Mesh mesh() const;

  /// The moved polytope's k-DOP along the same directions: the image of every point of this one, by exact
  /// arithmetic on the stored matrix, is inside. Slabs are tight to a few units in the last place of the
  /// coordinates.
  Kdop transformed(const Eigen::Isometry3d& transform) const;

  /// Grows to hold the point: each slab takes its exact projection, rounded outward to the next double where
  /// it is none itself. A point with a coordinate that is not finite is ignored.
  Kdop& extend(const Eigen::Vector3d& point);

  /// Grows to hold the other, slab by slab: exact, commutative and associative. Throws std::invalid_argument
  /// unless both have equal sets.
  Kdop& merge(const Kdop& other);

  FloatKdop cast_float() const;

 private:
  /// All min, then all max.
  const double* numbers() const { return many_.empty() ? few_.data() : many_.data(); }
  double* numbers() { return many_.empty() ? few_.data() : many_.data(); }
  void store(const SlabVector& min, const SlabVector& max);

  // Up to a 26-DOP without an allocation. Room for 49 slabs in each would make every AnyVolume 824 bytes
  // instead of 256, which a million clusters have to pay.
  static constexpr std::size_t few_slabs = 13;

  std::shared_ptr<const KdopSet> set_;
  std::array<double, 2 * few_slabs> few_{};
  std::vector<double> many_;  // of more slabs
};

/// Equal sets and the same numbers.
bool operator==(const Kdop& a, const Kdop& b);
inline bool operator!=(const Kdop& a, const Kdop& b) {
  return !(a == b);
}

}  // namespace pcl_bv
