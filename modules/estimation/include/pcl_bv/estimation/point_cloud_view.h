// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// From pcl::PointCloud to the PointView that kernels read.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include "pcl_bv/points/point_records.h"

namespace pcl_bv {

/// All points of a cloud. PointT is any type with members x, y, z side by side, all float or all double.
template <typename PointT>
PointView point_view(const pcl::PointCloud<PointT>& cloud) {
  return view_records(cloud.points.data(), cloud.size());
}

/// The points that `indices` names, in that order. Throws std::out_of_range, naming the index, if one is not
/// in the cloud.
template <typename PointT>
PointView point_view(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  static_assert(sizeof(pcl::index_t) == sizeof(std::int32_t), "PCL is built with another index type");
  return select_points(point_view(cloud), indices.data(), indices.size());
}

}  // namespace pcl_bv
