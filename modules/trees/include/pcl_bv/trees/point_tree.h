// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A search tree over the points of a cloud: nearest neighbours, points in volumes, first hit of a ray.
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

/// The first point that a moving sphere touches: the centre is then at origin + t direction.
struct PointHit {
  /// Index of the point in the cloud.
  std::int32_t index;
  /// Parameter along the direction, in multiples of its length; 0 or more.
  double t;
};

/// A point of the cloud and its distance from a volume.
struct PointDistance {
  std::int32_t index;
  double distance;
};

/// A copy of a cloud's valid points for spatial queries: a packed R-tree (Roussopoulos, Leifker 1985).
///
/// The points are in the order of a balanced k-d tree, 16 to a packet. Each packet has a box, each 16 boxes
/// have a common box, and so on. Building takes about 30 ns a point on one thread, so a tree can be built for
/// every sweep. The tree takes 18 bytes a float point or 30 bytes a double point, and the same again while it
/// is built.
///
/// Points are identified by their index in the cloud (PointView::index()). Coordinates and distances are in
/// the frame and unit of the points. Every query gives the result of testing all points one by one with the
/// double expression that its documentation states; boxes only skip points that cannot change the result. So
/// the result is the same for every Execution, and no point is missed. A tree without points finds nothing.
///
/// Const member functions may be called from several threads at once.
class PointTree {
 public:
  /// An empty tree.
  PointTree() = default;

  /// Builds the tree of the view's valid points; dropped() is the number of the others. O(n log n). Throws
  /// std::invalid_argument unless the points are in memory, their number is at most 2^31 - 1, their indices
  /// are at most 2^31 - 2 and Execution::supports is null.
  explicit PointTree(const PointView& points, const Execution& execution = {}) { assign(points, execution); }

  /// Replaces the points, as the constructor. Allocates only if there are more points than in any earlier
  /// call. Throws as the constructor does and then leaves the tree unchanged; if memory runs out, the tree is
  /// empty.
  void assign(const PointView& points, const Execution& execution = {});

  /// Moves the points: reads new coordinates of the same indices from `cloud` (a view without indices). O(n),
  /// without allocation.
  ///
  /// Queries give the same results as on a new tree, which is faster to query if the points have moved far. A
  /// point that is not valid in `cloud` is not found by any query until a later refit() gives it valid
  /// coordinates. Throws std::invalid_argument, and changes nothing, if `cloud` lacks one of the indices, has
  /// an index list or another scalar type.
  void refit(const PointView& cloud, const Execution& execution = {});

  std::size_t size() const { return tree_.count; }  ///< Number of points in the tree.
  std::size_t dropped() const { return dropped_; }  ///< Number of points of the view that were not valid.
  /// Whether the tree has no points.
  bool empty() const { return tree_.count == 0; }

  /// Returns the point of the tree nearest to the query point, if it is within `max_distance`.
  ///
  /// Of equally near points it returns the one with the smallest index. "Within" means that
  /// Neighbor::squared_distance is at most max_distance * max_distance, rounded. Returns nothing if
  /// is_valid() does not hold for the query point. Throws std::invalid_argument if max_distance is negative
  /// or NaN.
  std::optional<Neighbor> nearest(const Eigen::Vector3d& point,
                                  double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Replaces `found` by the k nearest points within `max_distance`, in ascending order of Neighbor.
  /// Otherwise as nearest().
  void nearest(const Eigen::Vector3d& point, std::size_t k, std::vector<Neighbor>& found,
               double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Replaces `found` by all points within `distance` of the query point, in unspecified order. Otherwise as
  /// nearest().
  void near(const Eigen::Vector3d& point, double distance, std::vector<Neighbor>& found) const;

  /// Returns whether any point is within `distance` of the query point. Otherwise as nearest().
  bool any_near(const Eigen::Vector3d& point, double distance) const;

  /// Returns whether any point is inside the volume: contains() of the volume decides. False for an empty
  /// volume. frustum.h makes a Hull of a view frustum.
  bool any_inside(const Sphere& sphere) const;
  bool any_inside(const AnyVolume& volume) const;

  /// Returns the number of points inside the volume. 0 for an empty volume.
  std::size_t count_inside(const AnyVolume& volume) const;

  /// Replaces `indices` by the indices of the points inside the volume, ascending.
  void all_inside(const AnyVolume& volume, std::vector<std::int32_t>& indices) const;

  /// Returns the point nearest to the volume, if its distance is at most `max_distance`.
  ///
  /// The distance is distance() of the point from the volume's ConvexBody (pair_queries.h); it is 0 inside.
  /// Of equally near points it returns the one with the smallest index. Returns nothing for an empty volume.
  /// Throws std::invalid_argument if max_distance is negative or NaN.
  std::optional<PointDistance> nearest_to(
      const AnyVolume& volume, double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Returns the first point that a moving sphere touches. The centre of the sphere moves along origin + t
  /// direction, t >= 0.
  ///
  /// It is the point with the smallest `enter` of Sphere(point, radius).intersect(origin, direction), and the
  /// smallest index among equals. For a ray, use a small radius. A zero direction tests the sphere at the
  /// origin. Returns nothing if the origin or the direction is not finite. Throws std::invalid_argument
  /// unless the radius is from 0 to 1e100.
  std::optional<PointHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                    double radius) const;

  /// Returns the points and boxes, for callers that traverse the tree themselves.
  const PackedTree& packed() const { return tree_; }
  /// Returns the instruction set of the queries: that of the last build.
  UsableIsa isa() const { return isa_; }

 private:
  // Buffers for building, retained for the next cloud. A copy of a tree has buffers of its own.
  struct Scratch;
  struct ReusedScratch {
    ReusedScratch() = default;
    ReusedScratch(const ReusedScratch&) {}
    // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): each keeps its own.
    ReusedScratch& operator=(const ReusedScratch&) { return *this; }
    ReusedScratch(ReusedScratch&&) = default;
    ReusedScratch& operator=(ReusedScratch&&) = default;
    std::shared_ptr<Scratch> scratch;
  };

  Scratch& scratch();

  PackedTree tree_;
  UsableIsa isa_ = Isa::scalar;
  std::size_t dropped_ = 0;
  ReusedScratch scratch_;
};

}  // namespace pcl_bv
