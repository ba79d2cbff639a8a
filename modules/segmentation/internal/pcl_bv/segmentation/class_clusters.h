// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters of points with class labels. Points of different classes are never in the same cluster.
#pragma once

#include <cstdint>
#include <vector>

#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// Options of one class.
struct ClassOptions {
  /// Value of the class.
  std::int64_t value = 0;
  /// Options of the clusters of this class.
  ClusterOptions clusters;
  /// Whether the points of this class are left out of all clusters; Clusters::class_points counts them.
  bool drop = false;
};

/// Runs an EuclideanClusterer for the points of each class.
class ClassClusterer {
 public:
  /// Replaces `clusters` by the clusters of all classes. The largest cluster is first; clusters of equal size
  /// are ordered by their smallest point index. Sets class_of[i] to the class of cluster i. classes[i] is the
  /// class of the point with index i. Classes without an entry in `class_options` use `defaults`.
  ///
  /// Without valid points there are no clusters. O(points * log(classes)) in addition to the clustering.
  /// Throws as EuclideanClusterer::extract() does. Throws std::invalid_argument if `class_options` has a
  /// class twice or a point has no entry in `classes`.
  void extract(const PointView& points, const std::vector<std::int64_t>& classes,
               const ClusterOptions& defaults, const std::vector<ClassOptions>& class_options,
               Clusters& clusters, std::vector<std::int64_t>& class_of, const Execution& execution = {});

 private:
  // The points of a class. Their indices are numbers_[end - count] to numbers_[end - 1].
  struct Group {
    std::int64_t value;
    std::size_t count, end;
  };

  void make_groups(const PointView& points, const std::vector<std::int64_t>& classes);
  Group& group_of(std::int64_t value);
  void sort_points(const PointView& points, const std::vector<std::int64_t>& classes);

  EuclideanClusterer clusterer_;
  std::vector<std::int64_t> values_;   // the classes, ascending
  std::vector<Group> groups_;          // of each of these
  std::vector<std::int32_t> numbers_;  // point indices, ordered by class
  Clusters found_, all_;
  std::vector<std::int64_t> found_class_;
  std::vector<std::size_t> order_;
};

}  // namespace detail
}  // namespace pcl_bv
