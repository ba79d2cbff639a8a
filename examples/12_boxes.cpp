// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits an upright box and the minimum-volume box to a PCL cloud.
#include <pcl/point_types.h>
#include <pcl_bv/pcl.h>

#include <cmath>
#include <iostream>

int main() {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (int i = 0; i < 600; ++i) {  // a box of 4 x 2 x 1.5 m, rotated by 0.5 rad about z
    const float x = 0.4F * static_cast<float>(i % 11) - 2, y = 0.4F * static_cast<float>(i / 11 % 6) - 1,
                z = 0.5F * static_cast<float>(i / 66 % 4);
    cloud->push_back({x * std::cos(0.5F) - y * std::sin(0.5F), x * std::sin(0.5F) + y * std::cos(0.5F), z});
  }

  pcl_bv::ObbEstimation<pcl::PointXYZ> estimation;  // by default ObbMethod::minimal, which may tilt the box
  estimation.setMethod(pcl_bv::ObbMethod::lshape);  // upright; default of the commands for clusters
  estimation.setUpAxis(Eigen::Vector3d::UnitZ());
  estimation.setInputCloud(cloud);
  pcl_bv::Obb box;
  const pcl_bv::EstimationResult result = estimation.compute(box);

  const Eigen::Vector3d size = 2 * box.half_extents();  // along box.axis(0), axis(1), axis(2), in metres
  const Eigen::Isometry3d pose = box.pose();            // from the box's own frame to the frame of the cloud

  const auto smallest = pcl_bv::fit_obb(*cloud);  // the minimum-volume box, by a function call instead of a class

  std::cout << size.transpose() << " m at " << pose.translation().transpose() << ", " << result.used << " points\n";
  return std::abs(size.prod() - 4 * 2 * 1.5) < 0.01 && smallest->volume() < box.volume() + 0.01 ? 0 : 1;
}
