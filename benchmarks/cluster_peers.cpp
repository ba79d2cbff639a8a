// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Peers of the clusterer.

#include "cluster_peers.h"

#include <pcl/search/kdtree.h>

#include <algorithm>
#include <memory>
#include <pcl/segmentation/impl/extract_clusters.hpp>
#include <utility>

#ifdef PCL_BV_BENCH_NANOFLANN
#include <nanoflann.hpp>
#endif

namespace pcl_bv::bench {
namespace {

ClusterSets by_pcl(const ClusterCloud::ConstPtr& cloud, float tolerance) {
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(false));
  extraction.setClusterTolerance(tolerance);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  ClusterSets sets;
  for (pcl::PointIndices& cluster : clusters)
    sets.push_back(std::move(cluster.indices));
  return sets;
}

#ifdef PCL_BV_BENCH_NANOFLANN
struct Adaptor {
  const ClusterCloud& cloud;
  std::size_t kdtree_get_point_count() const { return cloud.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return cloud[i].data[axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

ClusterSets by_nanoflann(const ClusterCloud::ConstPtr& cloud, float tolerance) {
  const Adaptor adaptor{*cloud};
  using Metric = nanoflann::L2_Simple_Adaptor<float, Adaptor>;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Adaptor, 3, int> tree(3, adaptor, {10});
  std::vector<std::pair<int, float>> near;
  std::vector<bool> seen(cloud->size());
  ClusterSets sets;
  for (std::size_t seed = 0; seed < cloud->size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = true;
    std::vector<int> queue{static_cast<int>(seed)};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      tree.radiusSearch((*cloud)[queue[i]].data, tolerance * tolerance, near,
                        nanoflann::SearchParams(32, 0, false));
      for (const auto& [j, d2] : near) {
        if (seen[j]) continue;
        seen[j] = true;
        queue.push_back(j);
      }
    }
    std::sort(queue.begin(), queue.end());
    sets.push_back(std::move(queue));
  }
  return sets;
}
#endif

}  // namespace

const std::vector<ClusterPeer>& cluster_peers() {
  static const std::vector<ClusterPeer> all{
      {"pcl", by_pcl},
#ifdef PCL_BV_BENCH_NANOFLANN
      {"nanoflann", by_nanoflann},
#endif
  };
  return all;
}

}  // namespace pcl_bv::bench
