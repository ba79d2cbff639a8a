// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters of points that a classifier has labelled: points of different classes never share one.
#pragma once

#include <cstdint>
#include <vector>

#include "pcl_bv/segmentation/euclidean_clusters.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// What the clusters of one class are.
struct ClassSettings {
  std::int64_t value = 0;
  ClusterSettings clusters;
  bool drop = false;  ///< Its points are in no cluster, and counted as such: Clusters::class_points.
};

/// EuclideanClusterer, class by class.
class ClassClusterer {
 public:
  /// Replaces `clusters` with those of each class in `points`, all of them the largest first, then by the smallest
  /// point number; `class_of` has the class of each. classes[i] is the class of point number i. Classes without
  /// settings of their own in `own` take `others`.
  ///
  /// Throws as EuclideanClusterer does, and std::invalid_argument if `own` names a class twice or a point has no
  /// entry in `classes`. No valid point: no clusters. O(points * log(classes)) besides the clusters themselves.
  void extract(const PointView& points, const std::vector<std::int64_t>& classes, const ClusterSettings& others,
               const std::vector<ClassSettings>& own, Clusters& clusters, std::vector<std::int64_t>& class_of,
               const ParallelPolicy& policy = Serial{});

 private:
  struct Group {
    std::int64_t value;
    std::size_t count, end;  // of its points in `numbers_`
  };

  std::size_t group_of(std::int64_t value);
  void sort_points(const PointView& points, const std::vector<std::int64_t>& classes);

  EuclideanClusterer clusterer_;
  std::vector<Group> groups_;  // ascending by value
  std::vector<std::int32_t> numbers_;
  Clusters found_, all_;
  std::vector<std::int64_t> found_class_;
  std::vector<std::size_t> order_;
};

}  // namespace pcl_bv
