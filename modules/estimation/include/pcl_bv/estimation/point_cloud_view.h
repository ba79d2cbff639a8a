// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Views of a pcl::PointCloud as a PointView, the input type of fits and kernels.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include "pcl_bv/points/point_records.h"

namespace pcl_bv {

/// Returns a view of all points of a cloud. PointT is any type with members x, y, z that are adjacent in
/// memory and either all float or all double. The cloud must outlive the view.
template <typename PointT>
PointView point_view(const pcl::PointCloud<PointT>& cloud) {
  return view_records(cloud.points.data(), cloud.size());
}

/// Returns a view of the points with these indices, in the order of `indices`. The cloud and `indices` must
/// outlive the view. Throws std::out_of_range for an index outside the cloud; the message contains the index.
template <typename PointT>
PointView point_view(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  static_assert(sizeof(pcl::index_t) == sizeof(std::int32_t),
                "PCL is built with an index type other than 32-bit integers");
  return point_view(cloud).subset(indices.data(), indices.size());
}

}  // namespace pcl_bv
