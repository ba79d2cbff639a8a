// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Cuts clusters that hold several objects.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "neck_cut.h"
#include "pcl_bv/points/point_view.h"
#include "pcl_bv/segmentation/class_clusters.h"
#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv {
namespace [[gnu::visibility("default")]] detail {

/// What is cut, and how.
struct RefineOptions {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();     ///< Of length 1.
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< Position of the sensor in the frame of the points.
  std::size_t min_size = 1;                          ///< Smallest number of points of a part.
  /// Classes whose min_size replaces that of these options. May be null.
  const std::vector<ClassOptions>* classes = nullptr;
};

/// Replaces clusters by their parts. Each point of a cluster is in exactly one part.
class ClusterRefiner {
 public:
  /// Cuts groups of people (NeckCut). The clusters keep the order that Clusters describes. `class_of` has the
  /// class of each cluster, or is empty. Sets `cut[i]` to 1 if cluster i is a part, otherwise to 0. Returns
  /// the number of clusters that were cut.
  std::size_t cut_at_necks(const PointView& cloud, const RefineOptions& options, Clusters& clusters,
                           std::vector<std::int64_t>& class_of, std::vector<std::uint8_t>& cut);

 private:
  struct Piece {
    std::size_t begin, size;  // in indices_
    std::size_t cluster;      // number of the cluster before the cut
    bool cut;
  };

  void add_parts(const Clusters& clusters, std::size_t cluster, std::size_t parts);
  void replace(Clusters& clusters, std::vector<std::int64_t>& class_of, std::vector<std::uint8_t>& cut);

  NeckCut neck_cut_;
  std::vector<std::uint32_t> part_of_;
  std::vector<std::int32_t> indices_;
  std::vector<Piece> pieces_;
  std::vector<std::int64_t> classes_;
};

}  // namespace detail
}  // namespace pcl_bv
