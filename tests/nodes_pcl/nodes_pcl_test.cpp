// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What needs more of PCL than its common library: grabbers, its own clusters, and that the window compiles.

#include <gtest/gtest.h>
#include <pcl/io/pcd_grabber.h>
#include <pcl/io/pcd_io.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "pcl_bv/nodes/cluster_pipeline.h"
#include "pcl_bv/nodes_pcl/grabber.h"
#include "pcl_bv/nodes_pcl/live_window.h"
#include "pcl_bv/synth/street.h"
#include "reference_clusters.h"
#include "temporary_folder.h"

namespace pcl_bv::detail {
namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr above_ground() {
  StreetOptions options;
  options.points = 16'000;
  const SynthCloud street = make_street_frame(options, 0).cloud;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (std::size_t i = 0; i < street.size(); ++i) {
    if (street.object[i] > 0)
      cloud->emplace_back(street.xyz[3 * i], street.xyz[3 * i + 1], street.xyz[3 * i + 2]);
  }
  return cloud;
}

TEST(ReferenceClusters, AreThoseOfTheExactClusterer) {
  const auto cloud = above_ground();
  for (const float tolerance : {0.2F, 0.5F, 1.0F}) {
    const ClusterOptions settings{tolerance, 5};
    Clusters reference, ours;
    extract_reference_clusters<pcl::PointXYZ>(cloud, settings, reference);
    EuclideanClusterer().extract(point_view(*cloud), settings, ours);
    EXPECT_GT(ours.size(), 10U);
    EXPECT_EQ(reference.indices, ours.indices);
    EXPECT_EQ(reference.offsets, ours.offsets);
  }
}

TEST(Grabber, FeedsARunnerByOneLine) {
  const test::TemporaryFolder folder;
  std::vector<std::string> files;
  for (int i = 0; i < 3; ++i) {
    files.push_back((folder / (std::to_string(i) + ".pcd")).string());
    ASSERT_EQ(pcl::io::savePCDFileBinary(files.back(), *above_ground()), 0);
  }
  FramePipeline pipeline;
  std::atomic<int> results{0};
  StreamRunner::Callbacks callbacks;
  callbacks.process = [&](const Frame& frame, FrameResult& result) { pipeline.process(frame, result); };
  callbacks.on_result = [&](const Frame&, const FrameResult& result) {
    EXPECT_GT(result.points, 1000U);
    ++results;
  };
  RunnerConfig config;
  config.policy = QueuePolicy::block;
  StreamRunner runner(callbacks, config);
  pcl::PCDGrabber<pcl::PointXYZ> grabber(files, 50, false);
  const boost::signals2::connection connection = connect<pcl::PointXYZ>(grabber, runner);
  grabber.start();
  for (int i = 0; i < 500 && results < 3; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  grabber.stop();
  connection.disconnect();
  runner.stop(StreamRunner::End::drain);
  EXPECT_GE(results, 3);
}

TEST(Grabber, OfAnotherPointTypeIsRefused) {
  pcl::PCDGrabber<pcl::PointXYZI> grabber(std::string("/nonexistent.pcd"), 1, false);
  StreamRunner::Callbacks callbacks;
  callbacks.process = [](const Frame&, FrameResult&) {};
  callbacks.on_result = [](const Frame&, const FrameResult&) {};
  StreamRunner runner(callbacks, RunnerConfig());
  EXPECT_THROW(connect<pcl::PointXYZ>(grabber, runner), std::invalid_argument);
}

// A window needs a display, which tests have not: its code is compiled, and not run.
[[maybe_unused]] bool draw(const FrameResult& result) {
  LiveWindow window;
  window.show(result);
  return window.spin_once();
}

}  // namespace
}  // namespace pcl_bv::detail
