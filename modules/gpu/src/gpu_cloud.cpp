// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/gpu/gpu_cloud.h"

#include <utility>

#include "device_points.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {

GpuCloud::GpuCloud(const GpuDevice& device, std::shared_ptr<const detail::DevicePoints> points)
    : device_(device), points_(std::move(points)) {}

GpuCloud::GpuCloud(const GpuDevice& device, const PointView& points, HostPoints host,
                   const Execution& execution)
    : device_(device) {
  const FloatEnvironment environment;
  points_ = std::make_shared<detail::DevicePoints>(device.context(), points, host, execution);
}

GpuCloud GpuCloud::import_memory(const GpuDevice& device, int fd, const ImportedPoints& layout) {
  const FloatEnvironment environment;
  return {device, std::make_shared<const detail::DevicePoints>(device.context(), fd, layout)};
}

std::size_t GpuCloud::size() const {
  return points_->size();
}

PointView GpuCloud::points() const {
  return points_->points();
}

}  // namespace pcl_bv
