// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A search tree over the points of a cloud. It finds nearest neighbours, points in volumes and the first hit
// of a ray.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/isa.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace [[gnu::visibility("default")]] pcl_bv {

class PointTree;

namespace detail {
struct PackedTree;

// Returns the points and boxes, for code that traverses the tree itself.
const PackedTree& packed_tree(const PointTree& tree);
}  // namespace detail

/// The first point that a moving sphere touches. The centre of the sphere is then at `origin + t *
/// direction`.
struct PointHit {
  /// Index of the point in the cloud.
  std::int32_t index;
  /// Parameter along the direction, in multiples of the direction's length; 0 or more.
  double t;
};

/// A point of the cloud and its distance from a volume.
struct PointDistance {
  std::int32_t index;
  double distance;
};

/// A copy of a cloud's valid points for spatial queries, as a packed R-tree (Roussopoulos, Leifker 1985).
///
/// The points are in the order of a balanced k-d tree, 16 to a packet. Each packet has a box, each 16 boxes
/// have a common box, and so on. Building takes about 30 ns per point on one thread, so a tree can be built
/// for every sweep. The tree takes 18 bytes per float point or 30 bytes per double point. The buffers for
/// building take another 34 bytes per float point or 66 bytes per double point. The tree retains the buffers
/// for the next assign().
///
/// Points are identified by their index in the cloud (PointView::index()). Coordinates and distances are in
/// the frame and unit of the points. Every query gives the same result as testing all points one by one, in
/// double, as documented for the query. The boxes only serve to skip points that cannot change the result. So
/// the result is the same for every Execution, and no point is missed. Queries of a tree without points find
/// nothing.
///
/// Const member functions may be called from several threads at the same time.
class PointTree {
 public:
  /// An empty tree.
  PointTree();

  /// Builds the tree of the view's valid points. dropped() returns the number of the other points. O(n log
  /// n). Throws std::invalid_argument unless the points are in memory, their number is at most 2^31 - 1,
  /// and their indices are at most 2^31 - 2.
  explicit PointTree(const PointView& points, const Execution& execution = {});
  ~PointTree();
  PointTree(const PointTree& other);
  PointTree& operator=(const PointTree& other);
  PointTree(PointTree&&) noexcept;  ///< The other tree is then empty.
  PointTree& operator=(PointTree&&) noexcept;

  /// Replaces the points by those of a view, like the constructor. Allocates only if there are more points
  /// than in any earlier call. Throws std::invalid_argument as the constructor does; the tree is then
  /// unchanged. If memory runs out, the tree is empty.
  void assign(const PointView& points, const Execution& execution = {});

  /// Moves the points: reads their new coordinates from `cloud`, at the same indices. `cloud` must not have
  /// an index list. O(n), without allocation.
  ///
  /// Queries give the same results as on a new tree. A new tree is faster to query if the points have moved
  /// far. A point that is not valid in `cloud` is not found by any query until a later refit() gives it valid
  /// coordinates. Throws std::invalid_argument, and changes nothing, if `cloud` has no point for one of the
  /// indices, has an index list or has another scalar type than the tree.
  void refit(const PointView& cloud, const Execution& execution = {});

  std::size_t size() const;     ///< Number of points in the tree.
  std::size_t dropped() const;  ///< Number of points of the view that were not valid.
  /// Whether the tree has no points.
  bool empty() const { return size() == 0; }

  /// Returns the point of the tree nearest to the query point, if it is within `max_distance`.
  ///
  /// If several points are equally near, returns the one with the smallest index. "Within" means that
  /// Neighbor::squared_distance is at most max_distance * max_distance, rounded. Returns nothing if
  /// is_valid() does not hold for the query point. Throws std::invalid_argument if max_distance is negative
  /// or NaN.
  std::optional<Neighbor> nearest(const Eigen::Vector3d& point,
                                  double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Replaces `found` by the k nearest points within `max_distance`, in ascending order of Neighbor. In all
  /// other respects like nearest() above.
  void nearest(const Eigen::Vector3d& point, std::size_t k, std::vector<Neighbor>& found,
               double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Replaces `found` by all points within `distance` of the query point, in unspecified order. "Within",
  /// invalid query points and errors are as for nearest().
  void near(const Eigen::Vector3d& point, double distance, std::vector<Neighbor>& found) const;

  /// Returns whether any point is within `distance` of the query point. "Within", invalid query points and
  /// errors are as for nearest().
  bool any_near(const Eigen::Vector3d& point, double distance) const;

  /// Returns whether contains() of the volume holds for any point. Returns false for an empty volume.
  /// frustum() converts a view frustum to a Hull.
  bool any_inside(const Sphere& sphere) const;
  bool any_inside(const AnyVolume& volume) const;

  /// Returns the number of points inside the volume. It is 0 for an empty volume.
  std::size_t count_inside(const AnyVolume& volume) const;

  /// Replaces `indices` by the indices of the points inside the volume, ascending.
  void all_inside(const AnyVolume& volume, std::vector<std::int32_t>& indices) const;

  /// Returns the point nearest to the volume, if its distance is at most `max_distance`.
  ///
  /// The distance is distance() of the point from the volume's ConvexBody (pair_queries.h). This distance is
  /// 0 for a point inside. If several points are equally near, returns the one with the smallest index.
  /// Returns nothing for an empty volume. Throws std::invalid_argument if max_distance is negative or NaN.
  std::optional<PointDistance> nearest_to(
      const AnyVolume& volume, double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Returns the first point that a moving sphere touches. The centre of the sphere moves along `origin + t *
  /// direction`, t >= 0.
  ///
  /// The point has the smallest `enter` of Sphere(point, radius).intersect(origin, direction), and among
  /// equals the smallest index. For a ray, use a small radius. If the direction is zero, returns the point
  /// with the smallest index in the sphere at the origin, with t = 0. Returns nothing if the origin or the
  /// direction is not finite. Throws std::invalid_argument unless the radius is from 0 to 1e100.
  std::optional<PointHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                    double radius) const;

  /// Returns the instruction set of the queries, which is that of the last build.
  UsableIsa isa() const;

 private:
  friend const detail::PackedTree& detail::packed_tree(const PointTree& tree);
  struct State;

  const State& state() const;

  std::unique_ptr<State> state_;  // null for a tree that was never assigned
};

/// Lists of neighbours, concatenated. The neighbours of query point i are neighbors[first[i]] to
/// neighbors[first[i + 1] - 1].
struct NeighborLists {
  /// The neighbours of all query points.
  std::vector<Neighbor> neighbors;
  /// Start of each query point's list in `neighbors`, and at the end the size of `neighbors`.
  std::vector<std::size_t> first;
};

/// Resizes `found` to the number of query points. Sets found[i] to PointTree::nearest() of the i-th query
/// point, or to index -1 and squared distance infinity if there is none. Throws std::invalid_argument if the
/// query points are not in memory, or if max_distance is negative or NaN.
void nearest(const PointTree& tree, const PointView& query_points, std::vector<Neighbor>& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// Lists the k nearest points of each query point, in ascending order of Neighbor. Throws like nearest()
/// above.
void nearest(const PointTree& tree, const PointView& query_points, std::size_t k, NeighborLists& found,
             double max_distance = std::numeric_limits<double>::infinity(), const Execution& execution = {});

/// Lists all points within `distance` of each query point, in ascending order of Neighbor. Throws like
/// nearest().
void near(const PointTree& tree, const PointView& query_points, double distance, NeighborLists& found,
          const Execution& execution = {});

/// Resizes `inside` to the number of volumes. Sets inside[i] to 1 if PointTree::any_inside() holds for volume
/// i, else to 0.
void any_inside(const PointTree& tree, const std::vector<Sphere>& spheres, std::vector<std::uint8_t>& inside,
                const Execution& execution = {});
void any_inside(const PointTree& tree, const std::vector<AnyVolume>& volumes,
                std::vector<std::uint8_t>& inside, const Execution& execution = {});

/// The points of a PointTree after a rigid motion. The points are not moved. Instead, each query is moved to
/// the tree's frame.
///
/// The tree must outlive this object. A query volume is moved back to the tree's frame and inflated by a
/// bound of the error of the inverse matrix. So a point p is found if the exact value of `pose * p` is inside
/// the volume. A point outside the volume is found only if its distance from the volume is below about 1e-15
/// of the coordinates. Query points are rounded when they are moved back, and distances are computed in the
/// tree's frame. Query points and distances are accurate to about 1e-15 of the coordinates. These errors are
/// larger if the axes of the pose are orthonormal only to 1e-6.
class PosedTree {
 public:
  /// Places `tree` at `pose`, the transform from the tree's frame to the frame of the queries. Throws
  /// std::invalid_argument unless the pose is finite and its axes are unit vectors and orthogonal to 1e-6.
  PosedTree(const PointTree& tree, const Eigen::Isometry3d& pose);

  /// Like the PointTree member functions of the same name, with arguments in the frame of the queries.
  std::optional<Neighbor> nearest(const Eigen::Vector3d& point,
                                  double max_distance = std::numeric_limits<double>::infinity()) const;
  void nearest(const Eigen::Vector3d& point, std::size_t k, std::vector<Neighbor>& found,
               double max_distance = std::numeric_limits<double>::infinity()) const;
  void near(const Eigen::Vector3d& point, double distance, std::vector<Neighbor>& found) const;

  /// Like the PointTree member functions of the same name, with the volume in the frame of the queries.
  bool any_inside(const AnyVolume& volume) const;
  std::size_t count_inside(const AnyVolume& volume) const;
  void all_inside(const AnyVolume& volume, std::vector<std::int32_t>& indices) const;

  /// Like PointTree::first_hit(), with origin and direction in the frame of the queries.
  std::optional<PointHit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                    double radius) const;

 private:
  AnyVolume moved_back(const AnyVolume& volume) const;

  const PointTree& tree_;
  Eigen::Isometry3d back_;  // inverse of the pose
  double rounding_;         // bound of |back_ (pose p) - p| for points p of the tree
};

}  // namespace pcl_bv
