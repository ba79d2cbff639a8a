// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Euclidean clusters without PCL: the same partition as pcl::EuclideanClusterExtraction, two orders of
// magnitude sooner, for commands and nodes that hold a PointView.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "pcl_bv/parallel/policy.h"
#include "pcl_bv/points/point_view.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What becomes of clusters above max_size.
enum class Oversized : std::uint8_t {
  drop,
  keep,  ///< They are clusters as others: max_size means nothing.
  /// Their points are clustered again with half the tolerance (and half of tolerance_per_metre), up to three times;
  /// what is still too large is dropped. Parts below min_size are dropped as small.
  split
};

/// What a cluster is.
struct ClusterSettings {
  /// Points nearer to each other than this belong together; unit of the points. Finite and > 0.
  float tolerance;
  std::size_t min_size = 1;                                        ///< Smaller clusters are dropped; points.
  std::size_t max_size = std::numeric_limits<std::size_t>::max();  ///< Larger clusters are dropped; points.
  /// DBSCAN's core condition, >= 1: so many points, itself included, are nearer than the tolerance to a core
  /// point. With 1 every point is core.
  std::size_t min_points = 1;
  /// By how much the tolerance grows with the distance from the origin, for sensors whose points are farther apart the
  /// farther out they are; finite and >= 0, and 0 with min_points above 1. A point at the distance d has the tolerance
  /// tolerance * 2^(i/4), i being the greatest whole number with which that is at most
  /// tolerance + tolerance_per_metre * d. Two points are linked where they are nearer than the smaller one's.
  float tolerance_per_metre = 0;
  Oversized oversized = Oversized::drop;
};

/// Clusters of a cloud: the largest first, among equal sizes the one with the smallest point number first.
/// Reuse keeps the capacity.
struct Clusters {
  std::vector<std::int32_t> indices;  ///< Point numbers of all clusters in turn; ascending inside a cluster.
  std::vector<std::size_t> offsets{0};  ///< Where each cluster begins in `indices`; size() + 1 entries.
  std::size_t small_points = 0;         ///< Points in clusters dropped for having fewer than min_size.
  std::size_t large_points = 0;         ///< Points in clusters dropped for having more than max_size.
  std::size_t noise_points = 0;         ///< Points that are neither core nor near to a core point.
  std::size_t class_points = 0;         ///< Points of classes that are dropped: ClassSettings::drop.

  std::size_t size() const { return offsets.size() - 1; }
  std::size_t cluster_size(std::size_t i) const { return offsets[i + 1] - offsets[i]; }
  const std::int32_t* cluster(std::size_t i) const { return indices.data() + offsets[i]; }
};

/// Finds the connected components of the graph that joins two points when their distance is below the
/// tolerance.
///
/// The decision for a pair is PCL's to the last bit: d2 < r2, strictly, where d2 = (dx*dx + dy*dy) + dz*dz
/// and r2 = tolerance * tolerance are rounded to the scalar of the points (float32 or float64) after each
/// operation. So points at exactly the tolerance are apart, and a tolerance whose square is 0 in float joins
/// not even duplicates.
///
/// With min_points > 1 these are the clusters of DBSCAN (Ester et al. 1996): core points that are linked
/// belong together; another point that is linked to core points belongs to the nearest of them (by d2; of
/// several the one of the smallest number), so that the result does not depend on the order in which points
/// are visited; the rest is noise. A cluster's size counts all its points, core or not.
///
/// Method: cells of side just under tolerance / sqrt(3), whose points always belong together, joined by
/// union-find with the cells at most two away (exact grid DBSCAN: Gunawan 2013, Gan and Tao 2015); here by
/// blocks of 64 cells, so that one comparison settles most neighbours. O(n) for points as a sensor sees them,
/// whatever the number of neighbours, and O(n^1.5) where dense sheets lie just out of each other's reach. A
/// cell of min_points points is core without a test; points of others ask the cells around until they have
/// enough: at most O(n * min_points) tests.
///
/// A tolerance that grows with the range is one pass for each quarter octave of its growth, over the points that reach
/// it: from 0.3 m with 0.01 m a metre, nine within 110 m.
class EuclideanClusterer {
 public:
  EuclideanClusterer();
  ~EuclideanClusterer();
  EuclideanClusterer(EuclideanClusterer&&) noexcept;
  EuclideanClusterer& operator=(EuclideanClusterer&&) noexcept;

  /// Replaces `clusters` with those of `points`. Points that are not valid (is_valid()) are skipped; a point
  /// named twice by the index list counts once. No valid point: no clusters. A lone point is a cluster of
  /// one.
  ///
  /// Throws std::invalid_argument if a setting is not what ClusterSettings says or min_size > max_size,
  /// std::length_error if a point number exceeds 2^31 - 1. Threads never change the result, and none
  /// are used for fewer than 16 384 points or 512 blocks of 64 cells. Memory is kept for the next call, which
  /// needs no more for a cloud like this one: about 50 bytes a point and 150 a block; with min_points > 1, 9
  /// and 16 more. From 2^18 blocks on, most of what belongs to blocks is given back at once.
  void extract(const PointView& points, const ClusterSettings& settings, Clusters& clusters,
               const ParallelPolicy& policy = Serial{});

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace pcl_bv
