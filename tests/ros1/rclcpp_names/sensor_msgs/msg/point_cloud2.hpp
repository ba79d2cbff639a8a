// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <memory>

namespace sensor_msgs::msg {

struct PointCloud2 : sensor_msgs::PointCloud2 {
  using UniquePtr = std::unique_ptr<PointCloud2>;
};

}  // namespace sensor_msgs::msg
