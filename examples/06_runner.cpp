// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs the pipeline behind a queue. The sensor's callback only pushes clouds into the queue, and a thread of
// the StreamRunner processes the clouds.
#include <pcl/point_types.h>
#include <pcl_bv/nodes/cluster_pipeline.h>
#include <pcl_bv/nodes/stream_runner.h>

#include <cstdio>

int main() {
  pcl_bv::PipelineConfig config;
  config.ground.method = pcl_bv::GroundMethod::none;
  config.volumes = {"aabb"};
  pcl_bv::FramePipeline pipeline(config);
  pcl_bv::StreamRunner::Callbacks callbacks;
  callbacks.process = [&](const pcl_bv::Frame& frame, pcl_bv::FrameResult& result) {
    pipeline.process(frame, result);
  };
  callbacks.on_result = [](const pcl_bv::Frame& frame, const pcl_bv::FrameResult& result) {
    std::printf("frame %d: %d objects\n", static_cast<int>(frame.header.number),
                static_cast<int>(result.clusters.size()));
  };
  pcl_bv::StreamRunner runner(callbacks,
                              pcl_bv::RunnerConfig());  // queue of one frame, which a newer frame replaces
  const auto sensor_callback = [&](const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& cloud) {
    runner.push(pcl_bv::make_frame<pcl::PointXYZ>(cloud));
  };
  for (unsigned frame = 0; frame < 5; ++frame) {
    pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
    for (int i = 0; i < 200; ++i)
      cloud->push_back({5, 0.01F * static_cast<float>(i), 0.1F * static_cast<float>(i % 9)});
    cloud->header.seq = frame;
    sensor_callback(cloud);
  }
  runner.stop(pcl_bv::StreamRunner::End::drain);
  const pcl_bv::FrameTotals frames = runner.stats().frames;
  return frames.in == 5 && frames.processed + frames.dropped_queue == 5 ? 0 : 1;
}
