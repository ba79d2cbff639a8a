// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Size limits in metres: drops clusters by the sides of their upright boxes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

enum class ExtentVerdict : std::uint8_t { keep, small, large };

/// Returns whether the sides of the upright box of the points are within `config.min_extent` and
/// `config.max_extent`. `up` is the unit vector against gravity.
ExtentVerdict extent_verdict(const PointView& points, const ClusterConfig& config, const Eigen::Vector3d& up,
                             const Execution& execution);

class ExtentLimits {
 public:
  /// Drops the clusters outside `config.min_extent` and `config.max_extent`, and adds their points to
  /// small_points and large_points of `clusters`. The other clusters keep their order. `views` are the points
  /// of the clusters, and `up` is the unit vector against gravity. `class_of` and `refinements` have an entry
  /// for each cluster, or none.
  void apply(const ClusterConfig& config, const Eigen::Vector3d& up, const std::vector<PointView>& views,
             const Execution& execution, Clusters& clusters, std::vector<std::int64_t>& class_of,
             std::vector<Refinement>& refinements);

 private:
  void drop(Clusters& clusters, std::vector<std::int64_t>& class_of,
            std::vector<Refinement>& refinements) const;

  std::vector<ExtentVerdict> verdicts_;  // for each cluster; a member to reuse its memory
};

}  // namespace detail
}  // namespace pcl_bv
