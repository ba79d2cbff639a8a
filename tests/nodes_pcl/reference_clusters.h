// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// PCL's Euclidean clustering with FLANN's tree, as a reference for tests of EuclideanClusterer.
#pragma once

#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <limits>

#include "pcl_bv/segmentation/clusters.h"

namespace pcl_bv {
using namespace detail;

/// Computes the clusters of a cloud with pcl::EuclideanClusterExtraction, in the order of EuclideanClusterer.
/// The result equals that of EuclideanClusterer. The computation takes some hundred times longer. The
/// cloud must be dense and not organised, because PCL's tree requires this.
template <typename PointT>
void extract_reference_clusters(const typename pcl::PointCloud<PointT>::ConstPtr& cloud,
                                const ClusterOptions& settings, Clusters& clusters) {
  pcl::EuclideanClusterExtraction<PointT> extraction;
  extraction.setClusterTolerance(settings.tolerance);
  extraction.setMinClusterSize(static_cast<pcl::uindex_t>(settings.min_size));
  extraction.setMaxClusterSize(static_cast<pcl::uindex_t>(
      std::min<std::size_t>(settings.max_size, std::numeric_limits<std::int32_t>::max())));
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> found;
  extraction.extract(found);
  for (pcl::PointIndices& cluster : found)
    std::sort(cluster.indices.begin(), cluster.indices.end());
  std::sort(found.begin(), found.end(), [](const pcl::PointIndices& a, const pcl::PointIndices& b) {
    if (a.indices.size() != b.indices.size()) return a.indices.size() > b.indices.size();
    return a.indices < b.indices;
  });
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  clusters.small_points = clusters.large_points = 0;  // PCL does not report them
  for (const pcl::PointIndices& cluster : found) {
    clusters.indices.insert(clusters.indices.end(), cluster.indices.begin(), cluster.indices.end());
    clusters.offsets.push_back(clusters.indices.size());
  }
}

}  // namespace pcl_bv
