// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Volumes around one of PCL's clouds: no class, no pipeline.
#include <pcl/point_types.h>
#include <pcl_bv/estimation/fit_cloud.h>
#include <pcl_bv/fitting/methods.h>
#include <pcl_bv/fitting/partial.h>
#include <pcl_bv/points/point_groups.h>

#include <cmath>
#include <iostream>

int main() {
  pcl::PointCloud<pcl::PointXYZ> cloud;  // a ball of radius 1
  for (int i = 0; i < 5000; ++i) {
    const float turn = 2.4F * static_cast<float>(i), z = 1 - (static_cast<float>(i) + 0.5F) / 2500;
    cloud.push_back({10 + std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z});
  }
  const Eigen::Vector3d origin(0, 0, 0), ray(1, 0, 0);
  const pcl_bv::Obb previous;
  const std::vector<pcl_bv::PointView> views{pcl_bv::point_view(cloud)};

  const pcl_bv::CloudSummary all = pcl_bv::summarize(cloud);      // one pass: all.aabb(), all.dop26(), all.centroid, all.covariance

  const auto directions = std::make_shared<pcl_bv::KdopSet>(std::vector<Eigen::Vector3d>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 4, 0}});
  pcl_bv::Kdop kdop;
  pcl_bv::SlabPoints touching;                                    // the point that touches each side of each slab
  pcl_bv::fit_kdop(cloud, directions, kdop, touching, {pcl_bv::OpenMP{2}});
  pcl_bv::Sphere sphere;
  pcl_bv::SphereCertificate proof;                                // up to four points, weighted: no sphere is smaller
  pcl_bv::fit_smallest_sphere(cloud, sphere, proof);              // or SphereEstimation's compute(sphere, proof)
  if (const auto hit = kdop.intersect(origin, ray)) std::cout << hit->enter << "\n";

  pcl_bv::Obb box;                                                // centre, axes, half extents; pose(), quaternion()
  pcl_bv::fit_obb(cloud, {pcl_bv::ObbMethod::yaw, Eigen::Vector3d::UnitZ()}, box);
  box = box.oriented_as(previous);                                // a tracker's box does not flip

  pcl_bv::Partial tiles;                                          // a cloud in parts, here or on other machines (to_bytes())
  for (const pcl_bv::PointView& tile : views) tiles.merge(pcl_bv::Partial(tile, tiles.size()));
  pcl_bv::AnyVolume smallest_box;                                 // the bits of a fit to the whole cloud
  tiles.fit(*pcl_bv::find_method("obb-min"), smallest_box);

  const pcl_bv::PointGroups groups(pcl_bv::point_view(cloud));    // structure of arrays (kernels/point_groups.h), for several fits
  pcl_bv::fit_kdop(groups.view(), pcl_bv::KdopSet::dop26(), kdop);

  return sphere.radius() < 1.001 && touching.min.size() == 4 && !box.empty() ? 0 : 1;
}
