// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A FramePipeline for PCL's clouds. Programs that include this header link pcl_bv::estimation in addition to
// pcl_bv::nodes.
#pragma once

#include <pcl/point_cloud.h>

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "pcl_bv/estimation/fit_cloud.h"
#include "pcl_bv/nodes/frame_pipeline.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// Returns a frame that shares the cloud; nothing is copied. PCL's stamp in microseconds becomes nanoseconds.
/// Frame::sensor is stored_sensor_position() of the cloud's sensor_origin_ (VIEWPOINT of a .pcd file). Throws
/// std::invalid_argument if `cloud` is null.
template <typename PointT>
Frame make_frame(typename pcl::PointCloud<PointT>::ConstPtr cloud) {
  if (cloud == nullptr) throw std::invalid_argument("make_frame: the cloud is a null pointer");
  Frame frame;
  constexpr std::uint64_t max_microseconds = INT64_MAX / 1000;
  const std::uint64_t microseconds =
      cloud->header.stamp < max_microseconds ? cloud->header.stamp : max_microseconds;
  frame.header = {cloud->header.seq, static_cast<std::int64_t>(microseconds) * 1000, cloud->header.frame_id};
  frame.points = point_view(*cloud);
  const auto& sensor = cloud->sensor_origin_;
  frame.sensor = stored_sensor_position({sensor.x(), sensor.y(), sensor.z()});
  frame.owner = std::move(cloud);
  return frame;
}

/// FramePipeline for PCL clouds of any point type, also user-defined ones.
template <typename PointT>
class ClusterPipeline : public FramePipeline {
 public:
  using Cloud = pcl::PointCloud<PointT>;
  using FramePipeline::FramePipeline;
  using FramePipeline::process;

  /// Same as FramePipeline::process(). If `cloud` is null, throws std::invalid_argument and leaves `result`
  /// unchanged.
  void process(const typename Cloud::ConstPtr& cloud, FrameResult& result) {
    process(make_frame<PointT>(cloud), result);
  }
};

}  // namespace pcl_bv
