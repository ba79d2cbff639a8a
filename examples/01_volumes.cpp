// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to a PCL cloud with single function calls, without a class or a pipeline.
#include <pcl/point_types.h>
#include <pcl_bv/estimation/fit_cloud.h>
#include <pcl_bv/fitting/methods.h>
#include <pcl_bv/fitting/partial.h>
#include <pcl_bv/points/point_groups.h>

#include <cmath>
#include <iostream>

int main() {
  pcl::PointCloud<pcl::PointXYZ> cloud;  // points on a sphere of radius 1 m
  for (int i = 0; i < 5000; ++i) {
    const float turn = 2.4F * static_cast<float>(i), z = 1 - (static_cast<float>(i) + 0.5F) / 2500;
    cloud.push_back({10 + std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z});
  }
  const Eigen::Vector3d origin(0, 0, 0), ray(1, 0, 0);
  const pcl_bv::Obb previous;
  const std::vector<pcl_bv::PointView> views{pcl_bv::point_view(cloud)};

  // One pass over the cloud gives all.aabb(), all.dop26(), all.centroid and all.covariance.
  const pcl_bv::CloudSummary all = pcl_bv::summarize(cloud);

  const auto directions = std::make_shared<pcl_bv::KdopSet>(std::vector<Eigen::Vector3d>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 4, 0}});
  pcl_bv::Kdop kdop;
  pcl_bv::SlabPoints touching;  // indices of the points that touch the sides of each slab
  pcl_bv::fit_kdop(cloud, directions, kdop, touching, {pcl_bv::OpenMP{2}});
  pcl_bv::Sphere sphere;
  pcl_bv::SphereCertificate proof;                    // up to four weighted points: no sphere can be smaller
  pcl_bv::fit_smallest_sphere(cloud, sphere, proof);  // or compute(sphere, proof) of SphereEstimation
  if (const auto hit = kdop.intersect(origin, ray)) std::cout << hit->enter << "\n";

  pcl_bv::Obb box;  // center(), axes(), half_extents(), pose(), quaternion()
  pcl_bv::fit_obb(cloud, {pcl_bv::ObbMethod::yaw, Eigen::Vector3d::UnitZ()}, box);
  box = box.oriented_as(previous);  // the axes follow the previous box: a tracked box does not flip

  // Tiles of a cloud can be processed here or on other machines (to_bytes()) and merged.
  pcl_bv::Partial tiles;
  for (const pcl_bv::PointView& tile : views) tiles.merge(pcl_bv::Partial(tile, tiles.size()));
  pcl_bv::AnyVolume smallest_box;  // gets the same bits as from a fit to the whole cloud
  tiles.fit(*pcl_bv::find_method("obb-min"), smallest_box);

  // A copy as a structure of arrays (points/point_groups.h), for several fits to the same points.
  const pcl_bv::PointGroups groups(pcl_bv::point_view(cloud));
  pcl_bv::fit_kdop(groups.view(), pcl_bv::KdopSet::dop26(), kdop);

  return sphere.radius() < 1.001 && touching.min.size() == 4 && !box.empty() ? 0 : 1;
}
