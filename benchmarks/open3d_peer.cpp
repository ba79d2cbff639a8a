// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <open3d/geometry/PointCloud.h>

#include "cluster_peers.h"

namespace pcl_bv::bench {

std::vector<int> open3d_dbscan(const ClusterCloud& cloud, float tolerance, std::size_t min_points) {
  open3d::geometry::PointCloud points;
  for (const pcl::PointXYZ& p : cloud)
    points.points_.emplace_back(p.x, p.y, p.z);
  return points.ClusterDBSCAN(tolerance, min_points);
}

}  // namespace pcl_bv::bench
