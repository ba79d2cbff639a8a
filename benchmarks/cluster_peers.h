// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Others who find Euclidean clusters: breadth first, one search of a kd-tree per point. Every run builds its
// tree, as a stream of clouds makes it do.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl_bv::bench {

using ClusterCloud = pcl::PointCloud<pcl::PointXYZ>;
using ClusterSets = std::vector<std::vector<int>>;  ///< Each ascending; in any order.

struct ClusterPeer {
  std::string name;
  ClusterSets (*run)(const ClusterCloud::ConstPtr&, float tolerance);
};

/// "pcl" (pcl::EuclideanClusterExtraction over pcl::search::KdTree, unsorted) and, where libnanoflann-dev is
/// installed, "nanoflann" (the same search on its tree).
const std::vector<ClusterPeer>& cluster_peers();

/// Open3D's DBSCAN, on all processors: for each point its cluster, -1 for noise. Only where libopen3d-dev is
/// installed (PCL_BV_BENCH_OPEN3D).
std::vector<int> open3d_dbscan(const ClusterCloud& cloud, float tolerance, std::size_t min_points);

}  // namespace pcl_bv::bench
