// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Euclidean clusters of points, without PCL. The partition is that of pcl::EuclideanClusterExtraction.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

namespace detail {
struct ComponentAccess;
}

/// Numbers of points that are in no cluster, by reason, and how many clusters were cut and joined.
struct Counts {
  std::size_t nonfinite = 0;      ///< Points that are not valid (is_valid()).
  std::size_t range = 0;          ///< Valid points outside the range limits or on the own vehicle.
  std::size_t ground = 0;         ///< Points removed as ground.
  std::size_t small = 0;          ///< Points in clusters that are too small.
  std::size_t large = 0;          ///< Points in clusters that are too large.
  std::size_t noise = 0;          ///< Noise points; see ClusterOptions::min_points.
  std::size_t inside = 0;         ///< Points inside a region to drop, or outside all regions to keep.
  std::size_t dropped_class = 0;  ///< Points of a class that is dropped.
  std::size_t cut = 0;            ///< Clusters that were cut into several objects.
  std::size_t joined = 0;         ///< Objects that were joined from several clusters.
};

/// What changed a cluster after the clustering.
enum class Refinement : std::uint8_t {
  none,   ///< Nothing.
  cut,    ///< It is a part of a larger cluster.
  joined  ///< It was joined from several clusters.
};

/// Treatment of clusters with more than max_size points.
enum class Oversized : std::uint8_t {
  drop,  ///< Such clusters are dropped.
  keep,  ///< Such clusters are retained; max_size is ignored.
  /// The points of such a cluster are clustered again with half the tolerance and half of
  /// tolerance_per_metre, up to three times. Clusters that are then still too large are dropped and counted
  /// as large. Parts with fewer than min_size points are dropped and counted as small.
  split
};

/// Options of a clustering.
struct ClusterOptions {
  /// Points nearer to each other than this are linked. Unit of the points; finite and > 0.
  float tolerance = 0;
  /// Clusters with fewer points are dropped.
  std::size_t min_size = 1;
  /// Clusters with more points are treated as `oversized` says.
  std::size_t max_size = std::numeric_limits<std::size_t>::max();
  /// Number of points in the core condition of DBSCAN, >= 1. A point is a core point if at least this number
  /// of points, itself included, are nearer than the tolerance. With 1 every point is a core point. Points at
  /// exactly the tolerance do not count, as in PCL. Ester et al. and scikit-learn count them (<=).
  std::size_t min_points = 1;
  /// Growth of the tolerance for each unit of distance from `range_origin`, for sensors whose points are
  /// sparser farther out. Finite and >= 0; must be 0 if min_points is above 1.
  ///
  /// A point at the distance d has the tolerance tolerance * 2^(i/4). Here i is the largest integer for which
  /// this value is at most tolerance + tolerance_per_metre * d. Two points are linked if their distance is
  /// below the smaller of their tolerances.
  float tolerance_per_metre = 0;
  /// Treatment of clusters with more than max_size points.
  Oversized oversized = Oversized::drop;
  /// Position from which tolerance_per_metre measures distances, in the frame of the points. Each coordinate
  /// is from -1e100 to 1e100.
  Eigen::Vector3d range_origin = Eigen::Vector3d::Zero();
};

/// The clusters of a cloud. The largest cluster is first; clusters of equal size are ordered by their
/// smallest point index. Within a cluster the indices are ascending. Reusing an object reuses its memory.
struct Clusters : IndexLists {
  std::size_t small_points = 0;  ///< Number of points in dropped clusters with fewer than min_size points.
  std::size_t large_points = 0;  ///< Number of points in dropped clusters with more than max_size points.
  std::size_t noise_points = 0;  ///< Number of points that are neither core points nor linked to one.
  std::size_t class_points = 0;  ///< Number of points of classes that are dropped.
};

/// Finds Euclidean clusters. These are the connected components of the graph that links two points if their
/// distance is below the tolerance.
///
/// The test of a pair of points is d2 < r2, which gives exactly the same result as PCL (Rusu 2009). Here d2 =
/// (dx*dx + dy*dy) + dz*dz and r2 = tolerance * tolerance, rounded to the scalar type of the points after
/// each operation. Points at exactly the tolerance are not linked. If the square of the tolerance is 0 in
/// float, not even duplicates are linked.
///
/// With min_points > 1 these are the clusters of DBSCAN (Ester et al. 1996). Linked core points are in one
/// cluster. A border point is linked to core points but is not a core point. It belongs to the core point
/// with the smallest d2. If several core points have this d2, it belongs to the one with the smallest index.
/// So the result does not depend on the order of the index list. All other points are noise. The size of a
/// cluster includes border points.
///
/// The method is exact grid DBSCAN (Gunawan 2013, Gan and Tao 2015). Points in the same cell are linked,
/// because the side of a cell is just under tolerance / sqrt(3). Union-find joins cells that are at most two
/// cells apart. The cost is O(n) for usual sensor data, whatever the number of neighbours, and O(n log n) if
/// points are very far from each other. It is O(n^1.5) if dense sheets are just farther apart than the
/// tolerance. Clouds made to be slow may cost more: no exact method in O(n log n) is known for them (Gan and
/// Tao 2015). With min_points > 1 there are at most O(n * min_points) more distance tests. In dense cells,
/// boxes of points replace most of them, so that there are about O(n^(5/3)) if min_points grows with n.
///
/// With tolerance_per_metre > 0 there is one pass for each tolerance that a point has. Each pass links the
/// points of this tolerance to each other, and to points farther out that are near enough. A point takes part
/// in at most 4 log2(1.2 + 2 tolerance_per_metre) + 2 passes, mostly in two.
class EuclideanClusterer {
 public:
  /// Allocates nothing until the first extract().
  EuclideanClusterer();
  ~EuclideanClusterer();
  EuclideanClusterer(EuclideanClusterer&&) noexcept;
  EuclideanClusterer& operator=(EuclideanClusterer&&) noexcept;

  /// Replaces `clusters` by the clusters of `points`. With min_points = 1 a point without neighbours is a
  /// cluster of size one. Points that are not valid (is_valid()) are ignored. A point that is twice in the
  /// index list counts once. Without valid points there are no clusters.
  ///
  /// The number of threads never changes the result. Steps over points use one thread for fewer than 16 384
  /// points. Steps over blocks of 64 cells use one thread for at most 256 blocks.
  ///
  /// The object retains its memory for later calls: about 50 bytes per point and 150 bytes per block. With
  /// min_points > 1 it retains about 23 (float) or 37 (double) bytes per point and 16 bytes per block more.
  /// For 2^18 or more blocks, each call frees most of the memory for blocks before it returns.
  ///
  /// Throws std::invalid_argument if an option is outside its range or min_size > max_size, and
  /// std::length_error if a point index exceeds 2^31 - 1.
  void extract(const PointView& points, const ClusterOptions& options, Clusters& clusters,
               const Execution& execution = {});

 private:
  friend struct detail::ComponentAccess;
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

/// Finds the clusters of EuclideanClusterer with a single call. A program that finds clusters again and again
/// saves allocations with an EuclideanClusterer of its own.
Clusters cluster(const PointView& points, const ClusterOptions& options, const Execution& execution = {});

}  // namespace pcl_bv
