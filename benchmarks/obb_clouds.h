// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The clouds on which oriented boxes are compared, by name.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

#include "pcl_bv/points/point_view.h"
#include "pcl_bv/volumes/any_volume.h"

namespace pcl_bv::bench {

class ObbCloud {
 public:
  ObbCloud(std::string name, pcl::PointCloud<pcl::PointXYZ>::Ptr points)
      : name_(std::move(name)), points_(points) {}
  explicit ObbCloud(const PointView& points);  ///< A copy.

  const std::string& name() const { return name_; }
  const pcl::PointCloud<pcl::PointXYZ>& points() const { return *points_; }
  pcl::PointCloud<pcl::PointXYZ>::ConstPtr pointer() const { return points_; }
  PointView view() const;

 private:
  std::string name_;
  pcl::PointCloud<pcl::PointXYZ>::Ptr points_;
};

/// "gauss", "ball", "box" (turned), "car" (three sides, yawed), "L" (two) and "sphere" (all points on it)
/// with the number of points, and two meshes of meshes.h where they
/// are installed.
const std::vector<std::string>& obb_cloud_names();
const ObbCloud& obb_cloud(const std::string& name);

/// Cars, poles and blobs of as many points each, one after another.
ObbCloud make_clusters(std::size_t clusters, std::size_t points);

/// The least volume that obb-min or a peer gives.
double least_volume(const ObbCloud& cloud);

/// Throws if a point is outside by exact arithmetic.
void require_enclosed(const AnyVolume& volume, const PointView& points);

}  // namespace pcl_bv::bench
