// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs an algorithm of PCL with the search tree of pcl_bv, which is set by setSearchMethod().
#include <pcl/point_types.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl_bv/nodes_pcl/point_tree_search.h>

#include <iostream>

int main() {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (int i = 0; i < 100; ++i) {  // two objects, 20 m apart
    const float x = i < 50 ? 0.0F : 20.0F;
    cloud->push_back({x, 0.1F * static_cast<float>(i % 50), 0.3F * static_cast<float>(i % 2)});
  }

  // The argument false means that neighbours within a radius are not sorted by distance, which is faster.
  const auto tree = std::make_shared<pcl_bv::PointTreeSearch<pcl::PointXYZ>>(false);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSearchMethod(tree);
  extraction.setClusterTolerance(0.5);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);

  pcl::Indices nearest;
  std::vector<float> squared_distances;
  tree->nearestKSearch({19, 2, 0}, 3, nearest, squared_distances);
  std::cout << clusters.size() << " clusters; 1 m from a point: " << nearest.front() << "\n";
  return clusters.size() == 2 && nearest.size() == 3 && nearest.front() == 70 ? 0 : 1;
}
