// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Calls the pipeline from the program's own loop. The pipeline starts no thread and accesses no file.
#include <pcl/point_types.h>
#include <pcl_bv/nodes/cluster_pipeline.h>

#include <cstdio>

int main() {
  pcl_bv::PipelineConfig config;
  config.cluster.tolerance = 0.5;
  config.ground.method = pcl_bv::GroundMethod::none;
  config.volumes = {"aabb", "obb-yaw"};
  config.track.enabled = true;
  pcl_bv::ClusterPipeline<pcl::PointXYZ> pipeline(config);
  pcl_bv::FrameResult result;
  for (int frame = 0; frame < 5; ++frame) {
    pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
    for (int i = 0; i < 200; ++i)
      cloud->push_back({5 + 0.1F * static_cast<float>(frame), 0.01F * static_cast<float>(i),
                        0.1F * static_cast<float>(i % 9)});
    cloud->header.stamp = 100'000U * static_cast<unsigned>(frame);  // microseconds
    pipeline.process(cloud, result);
    for (const std::string& warning : result.warnings)  // without stamps, for example
      std::fprintf(stderr, "frame %d: %s\n", frame, warning.c_str());
    for (std::size_t i = 0; i < result.clusters.size(); ++i) {
      const Eigen::Vector3d center = pcl_bv::center(result.volume(i, 1));
      std::printf("frame %d: object %d at %.2f %.2f %.2f\n", frame,
                  result.tracks[i] ? static_cast<int>(result.tracks[i]->id) : -1, center.x(), center.y(),
                  center.z());
    }
  }
  return result.clusters.size() == 1 && result.tracks[0]->id == 0U ? 0 : 1;
}
