// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/nodes/cluster_pipeline.h"

#include <pcl/point_types.h>

#include <limits>

#include "frames.h"

namespace pcl_bv::detail {
namespace {

TEST(ClusterPipeline, TakesPclCloudsAsTheyAre) {
  const auto frames = street(1);
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZI>>();
  for (std::size_t i = 0; i < frames[0].size(); i += 3) {
    pcl::PointXYZI p;
    p.x = frames[0][i], p.y = frames[0][i + 1], p.z = frames[0][i + 2];
    cloud->push_back(p);
  }
  cloud->header.stamp = 1'234'567;
  cloud->header.seq = 3;
  cloud->header.frame_id = "velodyne";
  ClusterPipeline<pcl::PointXYZI> pipeline;
  FrameResult result, expected;
  pipeline.process(cloud, result);
  FramePipeline().process(third_orientation(frames[0], 0), expected);
  expect_equal(result, expected);
  EXPECT_EQ(result.header.stamp_ns, 1'234'567'000);
  EXPECT_EQ(result.header.frame_id, "velodyne");
  EXPECT_THROW(pipeline.process(nullptr, result), std::invalid_argument);
  EXPECT_THROW(pipeline.process(pcl::PointCloud<pcl::PointXYZI>::Ptr(), result), std::invalid_argument);
  expect_equal(result, expected);
}

TEST(ClusterPipeline, TakesTheSensorFromTheViewpoint) {
  const auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->push_back({1, 2, 3});
  EXPECT_FALSE(make_frame<pcl::PointXYZ>(cloud).sensor.has_value());
  cloud->sensor_origin_ = {100, -2, 0.5F, 0};
  EXPECT_EQ(make_frame<pcl::PointXYZ>(cloud).sensor, Eigen::Vector3d(100, -2, 0.5));
  cloud->sensor_origin_.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(make_frame<pcl::PointXYZ>(cloud).sensor.has_value());
}

}  // namespace
}  // namespace pcl_bv::detail
