// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// PCL's clouds as frames, and the pipeline for them; programs link pcl_bv::estimation beside pcl_bv::nodes.
#pragma once

#include <pcl/point_cloud.h>

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "pcl_bv/estimation/point_cloud_view.h"
#include "pcl_bv/nodes/frame_pipeline.h"

namespace [[gnu::visibility("default")]] pcl_bv {

/// The cloud as a frame that shares it: nothing is copied. PCL's stamps are microseconds. The sensor is at
/// sensor_origin_, PCL's reading of VIEWPOINT, unless that is 0. Throws std::invalid_argument for a null
/// pointer.
template <typename PointT>
Frame make_frame(typename pcl::PointCloud<PointT>::ConstPtr cloud) {
  if (cloud == nullptr) throw std::invalid_argument("make_frame: the cloud is a null pointer");
  Frame frame;
  constexpr std::uint64_t most = INT64_MAX / 1000;
  const std::uint64_t microseconds = cloud->header.stamp < most ? cloud->header.stamp : most;
  frame.header = {cloud->header.seq, static_cast<std::int64_t>(microseconds) * 1000, cloud->header.frame_id};
  frame.points = point_view(*cloud);
  const auto& sensor = cloud->sensor_origin_;
  frame.sensor = place_of_sensor({sensor.x(), sensor.y(), sensor.z()});
  frame.owner = std::move(cloud);
  return frame;
}

/// FramePipeline for clouds of one of PCL's point types, or of your own.
template <typename PointT>
class ClusterPipeline : public FramePipeline {
 public:
  using Cloud = pcl::PointCloud<PointT>;
  using FramePipeline::FramePipeline;
  using FramePipeline::process;

  /// As FramePipeline's. Throws std::invalid_argument for a null pointer; `result` stays as it was.
  void process(const typename Cloud::ConstPtr& cloud, FrameResult& result) {
    process(make_frame<PointT>(cloud), result);
  }
};

}  // namespace pcl_bv
