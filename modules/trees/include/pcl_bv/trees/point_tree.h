// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Questions to a cloud: what is near, what is inside, what does a ray hit.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/kernels/packed_tree.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Where a ray first comes as near to a point as it was asked: at origin + t direction.
struct PointHit {
  std::int32_t index;
  double t;
};

/// How far a point is from what was asked about.
struct PointDistance {
  std::int32_t index;
  double distance;
};

/// A copy of a cloud's valid points in the order of a balanced k-d tree, 16 to a packet, with boxes around
/// packets, and around 16 of those and so on: a packed R-tree (Roussopoulos, Leifker 1985). Building takes
/// some 30 ns a point on one thread, so a tree may serve one sweep. 18 bytes a point of float, 30 of double,
/// and as much again for building.
///
/// Points are named by their numbers in the cloud (PointView::index()). Each question is decided for every
/// point by the stated double expression, as if all were asked one after another: boxes only spare points
/// which the answer cannot depend on. So a tree gives the same answers for every Execution, and misses no
/// point. Places and distances are in the points' frame and unit. A tree of no points has nothing near or
/// inside.
///
/// Const calls may run side by side.
class PointTree {
 public:
  PointTree() = default;

  /// The view's valid points; others are counted. O(n log n). Throws std::invalid_argument unless the points
  /// are in memory and at most 2^31 - 1, and for Execution::supports.
  explicit PointTree(const PointView& points, const Execution& execution = {}) { assign(points, execution); }

  /// Replaces the contents; allocates only if more points come than ever before. Throws as the constructor
  /// does, and then the tree is as it was, or, if there is no memory, empty.
  void assign(const PointView& points, const Execution& execution = {});

  /// The same points, moved: takes new coordinates from a cloud in which they have the same numbers (a view
  /// without indices). Answers are as those of a new tree, which is faster to ask if they moved far. A point
  /// that is not valid there is near nothing and inside nothing, until it is moved back. O(n), and needs no
  /// memory. Throws std::invalid_argument for a view that lacks a number or has another scalar type, and then
  /// nothing is changed.
  void refit(const PointView& cloud, const Execution& execution = {});

  std::size_t size() const { return tree_.count; }  ///< Points in the tree.
  std::size_t dropped() const { return dropped_; }  ///< Points of the view that were not valid.
  bool empty() const { return tree_.count == 0; }

  /// The point nearest a place, of equally near ones that with the smallest number, if it is within
  /// max_distance: Neighbor::squared_distance is at most max_distance^2, rounded. None for a place that
  /// is_valid() does not count.
  std::optional<Neighbor> nearest(const Eigen::Vector3d& place,
                                  double max_distance = std::numeric_limits<double>::infinity()) const;

  /// The k nearest of them, ascending (Neighbor's order): replaces what is in `found`.
  void nearest(const Eigen::Vector3d& place, std::size_t k, std::vector<Neighbor>& found,
               double max_distance = std::numeric_limits<double>::infinity()) const;

  /// All points within a distance, in no order that means something: replaces what is in `found`.
  void near(const Eigen::Vector3d& place, double distance, std::vector<Neighbor>& found) const;

  /// Whether there is any point within a distance.
  bool any_near(const Eigen::Vector3d& place, double distance) const;

  /// Whether contains() of the volume holds for any point. A view frustum is a Hull: frustum.h.
  bool any_inside(const Sphere& sphere) const;
  bool any_inside(const AnyVolume& volume) const;

  /// Of how many points it holds.
  std::size_t count_inside(const AnyVolume& volume) const;

  /// Their numbers, ascending: replaces what is in `indices`.
  void all_inside(const AnyVolume& volume, std::vector<std::int32_t>& indices) const;

  /// The point with the least distance() from the volume's ConvexBody (pairs.h), 0 inside; of equal ones that
  /// with the smallest number, if it is within max_distance. Throws std::invalid_argument for one that is
  /// below 0 or NaN.
  std::optional<PointDistance> nearest_to(
      const AnyVolume& volume, double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Where a sphere whose centre moves along origin + t direction, t >= 0, first touches a point: the least
  /// enter of Sphere(point, radius).intersect(origin, direction), of equal ones that of the smallest number.
  /// A ray is a sphere of a small radius. None for numbers that are not finite. Throws std::invalid_argument
  /// for a radius that is not from 0 to 1e100.
  std::optional<PointHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                    double radius) const;

  /// What the tree is made of, and the instruction set of its questions, for those who walk it themselves.
  const PackedTree& packed() const { return tree_; }
  UsableIsa isa() const { return isa_; }

 private:
  // What building needs, kept for the next cloud; not copied.
  struct Scratch;
  struct KeptScratch {
    KeptScratch() = default;
    KeptScratch(const KeptScratch&) {}
    // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): each keeps its own.
    KeptScratch& operator=(const KeptScratch&) { return *this; }
    KeptScratch(KeptScratch&&) = default;
    KeptScratch& operator=(KeptScratch&&) = default;
    std::shared_ptr<Scratch> scratch;
  };

  Scratch& scratch();

  PackedTree tree_;
  UsableIsa isa_ = Isa::scalar;
  std::size_t dropped_ = 0;
  KeptScratch kept_;
};

}  // namespace pcl_bv
