// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The pipeline for PCL's clouds; programs link pcl_bv::estimation beside pcl_bv::nodes.
#pragma once

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/pcl_frame.h"

namespace [[gnu::visibility("default")]] pcl_bv {

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
