// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// pcl_load [TOLERANCE FILE...]: what a program with PCL does to files: load, clusters unless the tolerance is
// 0, and the box of each or of all.
#include <pcl/common/common.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <pcl/segmentation/impl/extract_clusters.hpp>
#include <vector>

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

std::vector<pcl::PointIndices> clusters_of(const Cloud::ConstPtr& cloud, double tolerance) {
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(false));
  extraction.setClusterTolerance(tolerance);
  extraction.setMinClusterSize(10);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  return clusters;
}

void print_box(const Eigen::Vector4f& low, const Eigen::Vector4f& high) {
  std::printf("%g %g %g %g %g %g\n", low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
}

}  // namespace

int main(int count, char** arguments) {
  const double tolerance = count > 1 ? std::atof(arguments[1]) : 0;
  for (int i = 2; i < count; ++i) {
    const auto cloud = std::make_shared<Cloud>();
    if (pcl::io::loadPCDFile(arguments[i], *cloud) != 0) return 1;
    Eigen::Vector4f low, high;
    if (tolerance == 0) {
      pcl::getMinMax3D(*cloud, low, high);
      print_box(low, high);
      continue;
    }
    for (const pcl::PointIndices& cluster : clusters_of(cloud, tolerance)) {
      pcl::getMinMax3D(*cloud, cluster, low, high);
      print_box(low, high);
    }
  }
}
