// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// From pcl::PointCloud to the PointView that kernels read. The only place that knows how PCL lays out points.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "pcl_bv/kernels/point_view.h"

namespace pcl_bv {

/// All points of a cloud. PointT is any type with members x, y, z side by side, all float or all double.
template <typename PointT>
PointView point_view(const pcl::PointCloud<PointT>& cloud) {
  using Scalar = std::remove_cv_t<decltype(PointT::x)>;
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>,
                "x, y, z are float or double");
  static_assert(std::is_same_v<Scalar, std::remove_cv_t<decltype(PointT::y)>> &&
                    std::is_same_v<Scalar, std::remove_cv_t<decltype(PointT::z)>>,
                "x, y, z have one type");
  if (cloud.empty()) return {};
  const PointT& front = cloud.points.front();
  const auto* record = reinterpret_cast<const std::byte*>(&front);
  const auto* x = reinterpret_cast<const std::byte*>(&front.x);
  PointView view = PointView::of(&front.x, sizeof(PointT), cloud.size());
  view.readable = sizeof(PointT) - static_cast<std::size_t>(x - record);
  return view;
}

/// The points that `indices` names, in that order. Throws std::out_of_range, naming the index, if one is not
/// in the cloud.
template <typename PointT>
PointView point_view(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  static_assert(sizeof(pcl::index_t) == sizeof(std::int32_t), "PCL is built with another index type");
  for (const pcl::index_t index : indices) {
    if (index < 0 || static_cast<std::size_t>(index) >= cloud.size()) {
      throw std::out_of_range("point index " + std::to_string(index) + " is outside the cloud of " +
                              std::to_string(cloud.size()) + " points");
    }
  }
  PointView view = point_view(cloud);
  view.indices = indices.data();
  view.count = indices.size();
  return view;
}

}  // namespace pcl_bv
