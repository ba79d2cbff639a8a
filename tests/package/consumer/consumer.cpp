// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits volumes to a cloud of a point type that neither PCL nor pcl_bv has ever seen.
#define PCL_NO_PRECOMPILE
#include <pcl/point_types.h>
#include <pcl_bv/estimation/bounding_volume_estimation.h>
#include <pcl_bv/estimation/fit_cloud.h>
#include <pcl_bv/points/point_groups.h>
#include <pcl_bv/segmentation/extract_clusters.h>

#include <cstdio>
#include <memory>
#include <vector>

struct RadarPoint {
  float doppler;
  float x, y, z;
  unsigned char quality;
};

struct SurveyPoint {
  double x, y, z;
};

int main() {
  pcl::PointCloud<RadarPoint>::Ptr cloud(new pcl::PointCloud<RadarPoint>);
  for (int i = 0; i < 1000; ++i) {
    const float side = i < 500 ? 0.0F : 10.0F;
    cloud->push_back(
        {0.5F, side + 0.001F * static_cast<float>(i % 100), 0.2F * static_cast<float>(i % 7), 1.0F, 3});
  }

  pcl_bv::EuclideanClusterExtraction<RadarPoint> extraction;
  extraction.setClusterTolerance(0.5);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);

  pcl_bv::KdopEstimation<RadarPoint, 26> estimation;
  estimation.setInputCloud(cloud);
  std::vector<pcl_bv::Kdop> kdops;
  estimation.compute(clusters, kdops);
  if (kdops.size() != 2 || kdops[0].max(0) > 1 || kdops[1].min(0) < 9) {
    std::puts("wrong clusters");
    return 1;
  }

  // What the README shows.
  const pcl_bv::CloudSummary all = pcl_bv::summarize(*cloud);
  const auto directions = std::make_shared<pcl_bv::KdopSet>(
      std::vector<Eigen::Vector3d>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 4, 0}});
  const auto touched =
      pcl_bv::fit_kdop_with_contacts(*cloud, directions, {pcl_bv::OpenMP{2}, pcl_bv::Isa::automatic});
  const pcl_bv::Kdop& kdop = *touched;
  const pcl_bv::SlabPoints& touching = touched.contacts;
  const auto hit = kdop.intersect({-5, 0.5, 1}, {1, 0, 0});
  pcl_bv::Obb obb = *pcl_bv::fit_obb(*cloud, {pcl_bv::ObbMethod::yaw, Eigen::Vector3d::UnitZ()});
  if (obb.oriented_as(obb) != obb || !obb.contains({0, 0.2, 1})) {
    std::puts("wrong oriented box");
    return 1;
  }
  const pcl_bv::PointGroups groups(pcl_bv::point_view(*cloud));
  pcl_bv::Kdop same = *pcl_bv::fit_kdop(groups.view(), directions);
  if (all.aabb != kdop.aabb() || touching.min.size() != 4 || !hit || hit->enter > 5 || same != kdop) {
    std::puts("wrong summary or k-DOP");
    return 1;
  }

  pcl::PointCloud<SurveyPoint> survey;
  survey.push_back({5e6, 4e5, 100});
  survey.push_back({5e6 + 1e-9, 4e5, 100});
  const auto box = pcl_bv::fit_aabb(survey);
  if (box.rank != 1 || box->max().x() != 5e6 + 1e-9) {
    std::puts("wrong box");
    return 1;
  }
  std::puts("ok");
  return 0;
}
