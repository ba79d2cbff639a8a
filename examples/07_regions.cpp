// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Filters the points on a robot's own arm. Points inside the inflated links are dropped first.
#include <pcl_bv/nodes/frame_pipeline.h>

#include <iostream>
#include <vector>

int main() {
  std::vector<float> xyz;
  for (int i = 0; i < 300; ++i) {  // an arm next to the sensor, and a box 3 m in front of it
    const float t = static_cast<float>(i) / 300;
    xyz.insert(xyz.end(), {0.5F * t, 0.3F, -0.2F});
    xyz.insert(xyz.end(), {3 + 0.2F * t, 0.01F * static_cast<float>(i % 30), 0.02F * static_cast<float>(i % 17)});
  }

  pcl_bv::PipelineConfig config;
  config.ground.method = pcl_bv::GroundMethod::none;
  config.filter.range_min = 0;
  pcl_bv::RegionConfig arm;  // same as --drop-inside arm.json --padding 0.05, with volumes instead of a file
  arm.volumes.emplace_back(pcl_bv::Capsule({0, 0.3, -0.2}, {0.5, 0.3, -0.2}, 0.04));
  arm.padding = 0.05;
  config.filter.regions = {arm};
  pcl_bv::FramePipeline pipeline(config);

  pcl_bv::Frame frame;
  frame.points = pcl_bv::PointView::of(xyz.data(), 3 * sizeof(float), xyz.size() / 3);
  pcl_bv::FrameResult result;
  pipeline.process(frame, result);
  std::cout << result.counts.inside << " points of the arm, " << result.clusters.size() << " object at "
            << pcl_bv::center(result.volume(0, 0)).transpose() << "\n";
  return result.counts.inside == 300 && result.clusters.size() == 1 ? 0 : 1;
}
