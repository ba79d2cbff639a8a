// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to a PCL cloud with single function calls, without a class or a pipeline.
#include <pcl/point_types.h>
#include <pcl_bv/pcl.h>

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

  // One pass over the cloud gives all.aabb, all.dop26, all.centroid and all.covariance.
  const pcl_bv::CloudSummary all = pcl_bv::summarize(cloud);

  const auto directions = std::make_shared<pcl_bv::KdopSet>(std::vector<Eigen::Vector3d>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 4, 0}});
  const auto kdop = pcl_bv::fit_kdop_with_contacts(cloud, directions, pcl_bv::OpenMP{2});
  const pcl_bv::SlabPoints& touching = kdop.contacts;  // indices of the points that touch the sides of each slab
  const auto sphere = pcl_bv::fit_smallest_sphere(cloud);  // its certificate proves the radius minimal to 1e-12
  if (const auto hit = kdop->intersect(origin, ray)) std::cout << hit->enter << "\n";

  const auto fitted = pcl_bv::fit_obb(cloud, {pcl_bv::ObbMethod::yaw, Eigen::Vector3d::UnitZ()});
  const pcl_bv::Obb box = fitted->oriented_as(previous);  // the axes follow the previous box: a tracked box does not flip

  // Tiles of a cloud can be processed here or on other machines (to_bytes()) and merged.
  pcl_bv::Partial tiles;
  for (const pcl_bv::PointView& tile : views) tiles.merge(pcl_bv::Partial(tile, tiles.size()));
  const auto smallest_box = tiles.fit(*pcl_bv::find_method("obb-min"));  // the same bits as a fit to the whole cloud

  // A copy as a structure of arrays (points/point_groups.h), for several fits to the same points.
  const pcl_bv::PointGroups groups(pcl_bv::point_view(cloud));
  const auto dop26 = pcl_bv::fit_kdop(groups.view());

  return sphere->radius() < 1.001 && touching.min.size() == 4 && !box.empty() && !pcl_bv::empty(*smallest_box) &&
                 dop26->volume() > 0
             ? 0
             : 1;
}
