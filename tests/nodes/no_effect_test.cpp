// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A setting that changes nothing is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pcl_bv/nodes/pipeline_config.h"
#include "pcl_bv/nodes/stream_runner.h"

namespace pcl_bv::detail {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> ineffective_settings(const std::string& yaml) {
  return parse_stream_config(yaml, "").pipeline.ineffective_settings();
}

TEST(WithoutEffect, AreNoSettingsOfTheDefaultsAndOfPresets) {
  EXPECT_THAT(ineffective_settings(""), IsEmpty());
  EXPECT_THAT(whole_cloud_config().ineffective_settings(), IsEmpty());
  for (const char* preset : {"road", "indoor", "table"}) {
    PipelineConfig config;
    apply_preset(preset, config);
    EXPECT_THAT(config.ineffective_settings(), IsEmpty()) << preset;
  }
}

TEST(WithoutEffect, AreSmoothAndGrowWithoutTracksOrUprightBoxes) {
  EXPECT_THAT(ineffective_settings("track: {smooth: true, grow: true}"),
              ElementsAre("track.smooth: has no effect without track.enabled",
                          "track.grow: has no effect without track.enabled"));
  for (const char* volumes : {"obb", "obb-pca", "obb-dito14", "aabb", "dop26, sphere"})
    EXPECT_THAT(
        ineffective_settings(std::string("volumes: [") + volumes + "]\ntrack: {enabled: true, grow: true}"),
        ElementsAre("track.grow: has no effect without an upright box, obb-yaw or obb-lshape"));
  for (const char* volumes : {"", "obb-yaw", "aabb, obb-lshape"})
    EXPECT_THAT(ineffective_settings(std::string("volumes: [") + volumes +
                                     "]\ntrack: {enabled: true, smooth: true, grow: true}"),
                IsEmpty());
}

TEST(WithoutEffect, AreTheGrowthOfNoSphereAndTheRuleForNothingOversized) {
  EXPECT_THAT(
      ineffective_settings("{growth: sequential, volumes: [sphere, aabb]}"),
      ElementsAre("growth: has no effect without a sphere that grows, sphere-ritter or sphere-epos*"));
  EXPECT_THAT(ineffective_settings("{growth: sequential, volumes: [sphere-epos26]}"), IsEmpty());
  EXPECT_THAT(ineffective_settings("cluster: {oversized: split}"),
              ElementsAre("cluster.oversized: has no effect without cluster.max_size"));
  EXPECT_THAT(ineffective_settings("cluster: {oversized: split, max_size: 500}"), IsEmpty());
}

TEST(WithoutEffect, IsAConcaveLengthWithoutAPrism) {
  EXPECT_THAT(ineffective_settings("{concave_length: 1, volumes: [obb]}"),
              ElementsAre("concave_length: has no effect without prism"));
  EXPECT_THAT(ineffective_settings("{concave_length: 1, volumes: [obb, prism]}"), IsEmpty());
}

TEST(WithoutEffect, IsARefinementOfTheWholeCloud) {
  EXPECT_THAT(ineffective_settings("cluster: {tolerance: 0, refine: neck}"),
              ElementsAre("cluster.refine: has no effect without cluster.tolerance"));
  EXPECT_THAT(ineffective_settings("cluster: {refine: neck}"), IsEmpty());
}

TEST(WithoutEffect, IsDeskewOfPointsThatAreNotSegmented) {
  EXPECT_THAT(ineffective_settings("{deskew: on, ground: {method: none}, cluster: {tolerance: 0}}"),
              ElementsAre("deskew: has no effect without ground.method or cluster.tolerance"));
  EXPECT_THAT(ineffective_settings("deskew: on"), IsEmpty());
}

TEST(WithoutEffect, AreSettingsOfTheGroundWhereNoneIsRemoved) {
  EXPECT_THAT(
      ineffective_settings("ground: {method: none, sensor_height: 1, distance: 0.1, max_slope_degrees: 5}"),
      ElementsAre("ground.sensor_height: has no effect without ground.method",
                  "ground.distance: has no effect without ground.method",
                  "ground.max_slope_degrees: has no effect without ground.method"));
  EXPECT_THAT(ineffective_settings("ground: {method: none, sensor: [1, 2, 3]}"),
              ElementsAre("ground.sensor: has no effect without ground.method zones"));
  EXPECT_THAT(ineffective_settings("ground: {method: plane, sensor: [1, 2, 3], sensor_height: 1}"),
              ElementsAre("ground.sensor: has no effect without ground.method zones"));
  EXPECT_THAT(ineffective_settings("{ground: {method: plane, sensor: [1, 2, 3]}, track: {enabled: true}}"),
              IsEmpty());
  EXPECT_THAT(ineffective_settings("ground: {method: slope, sensor_height: 1, cell_size: 2}"),
              ElementsAre("ground.sensor_height: has no effect without ground.method zones or plane"));
  EXPECT_THAT(ineffective_settings("ground: {method: plane, cell_size: 2}"),
              ElementsAre("ground.cell_size: has no effect without ground.method slope"));
  EXPECT_THAT(ineffective_settings("ground: {method: zones, sensor: [1, 2, 3], sensor_height: 1}"),
              IsEmpty());
}

}  // namespace
}  // namespace pcl_bv::detail
