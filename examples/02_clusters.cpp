// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Extracts clusters with the interface of PCL and fits a k-DOP to each cluster.
#include <pcl/point_types.h>
#include <pcl_bv/pcl.h>

#include <iostream>

int main() {
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZI>);
  for (int i = 0; i < 100; ++i) {  // two objects, 20 m apart
    pcl::PointXYZI p;
    p.x = i < 50 ? 0.0F : 20.0F;
    p.y = 0.1F * static_cast<float>(i % 50);
    p.z = 0.3F * static_cast<float>(i % 2);
    cloud->push_back(p);
  }

  // The setters and the result are the same as those of pcl::EuclideanClusterExtraction.
  pcl_bv::EuclideanClusterExtraction<pcl::PointXYZI> extraction;
  extraction.setInputCloud(cloud);
  extraction.setClusterTolerance(0.5);
  extraction.setMinClusterSize(30);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);

  pcl_bv::KdopEstimation<pcl::PointXYZI, 26> estimation;
  estimation.setInputCloud(cloud);
  std::vector<pcl_bv::Kdop> kdops;
  estimation.compute(clusters, kdops);  // one k-DOP per cluster; compute(kdop) fits the whole cloud
  for (const pcl_bv::Kdop& kdop : kdops) std::cout << kdop.center().transpose() << "  " << kdop.volume() << " m3\n";

  return kdops.size() == 2 ? 0 : 1;
}
