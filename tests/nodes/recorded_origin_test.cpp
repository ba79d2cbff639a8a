// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds whose coordinates were moved: what is measured from the sensor does not change.

#include <gtest/gtest.h>

#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/synth/street.h"

namespace pcl_bv {
namespace {

// A street in doubles, with rays without a return at the recorded origin.
std::vector<double> moved_street(const Eigen::Vector3d& by) {
  const std::vector<float> xyz = make_street_frame({30'000, 2}, 0).cloud.xyz;
  std::vector<double> moved(xyz.begin(), xyz.end());
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] += by[static_cast<Eigen::Index>(i % 3)];
  return moved;
}

FrameResult objects(const PipelineConfig& config, const Eigen::Vector3d& by) {
  const std::vector<double> xyz = moved_street(by);
  Frame frame;
  frame.points = PointView::of(xyz.data(), 24, xyz.size() / 3);
  frame.recorded_origin = by;
  FrameResult result;
  FramePipeline(config).process(frame, result);
  return result;
}

void expect_same_objects(const PipelineConfig& config) {
  const FrameResult right = objects(config, Eigen::Vector3d::Zero());
  EXPECT_GT(right.clusters.size(), 5U);
  for (const Eigen::Vector3d& by : {Eigen::Vector3d(-12, 5, 3), Eigen::Vector3d(300, -200, 0.5)}) {
    const FrameResult found = objects(config, by);
    EXPECT_EQ(found.clusters.offsets, right.clusters.offsets);
    EXPECT_EQ(found.clusters.indices, right.clusters.indices);
    EXPECT_EQ(found.counts.range, right.counts.range);
    EXPECT_EQ(found.ground.ground, right.ground.ground);
    EXPECT_EQ(found.warnings, right.warnings);
  }
}

PipelineConfig segmented() {
  PipelineConfig config;
  config.ground.method = GroundMethod::none;
  config.cluster.min_size = 30;
  config.volumes = {"aabb"};
  return config;
}

TEST(RecordedOrigin, IsWhereRangesAreMeasuredFrom) {
  PipelineConfig config = segmented();
  config.filter.range_min = 8;
  config.filter.range_max = 40;
  expect_same_objects(config);
}

TEST(RecordedOrigin, IsWhereGrowingTolerancesAreMeasuredFrom) {
  PipelineConfig config = segmented();
  config.cluster.tolerance = 0.3;
  config.cluster.tolerance_per_metre = 0.02;
  expect_same_objects(config);
}

TEST(RecordedOrigin, IsTheAssumedSensorOfGroundZonesAndPlanes) {
  PipelineConfig config = segmented();
  config.ground.sensor_height = 1.73;
  for (const GroundMethod method : {GroundMethod::zones, GroundMethod::plane}) {
    config.ground.method = method;
    expect_same_objects(config);
  }
}

TEST(RecordedOrigin, MovesTheBoxOfTheOwnVehicle) {
  PipelineConfig config = segmented();
  config.filter.own_box_min = Eigen::Vector3d(-12, -6, -3);
  config.filter.own_box_max = Eigen::Vector3d(12, 6, 3);
  expect_same_objects(config);
}

}  // namespace
}  // namespace pcl_bv
