// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Size limits in metres: cluster.min_extent and cluster.max_extent.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "frames.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/report/report.h"

namespace pcl_bv {
namespace {

PipelineConfig config_for(const Eigen::Vector3d& up = {0, 0, 1}) {
  PipelineConfig config;
  config.ground.method = GroundMethod::none;
  config.ground.up = up;
  config.filter.range_min = 0;
  config.cluster.tolerance = 0.6;
  config.cluster.min_size = 1;
  config.volumes = {"obb-yaw"};
  return config;
}

// Adds the eight corners of a box with sides of at most 0.5 m, rotated by `yaw` about z.
void add_box(std::vector<float>& xyz, const Eigen::Vector3d& at, const Eigen::Vector3d& sides, double yaw) {
  for (int corner = 0; corner < 8; ++corner) {
    const double u = (corner & 1) != 0 ? sides.x() : 0, v = (corner & 2) != 0 ? sides.y() : 0;
    xyz.push_back(static_cast<float>(at.x() + u * std::cos(yaw) - v * std::sin(yaw)));
    xyz.push_back(static_cast<float>(at.y() + u * std::sin(yaw) + v * std::cos(yaw)));
    xyz.push_back(static_cast<float>(at.z() + ((corner & 4) != 0 ? sides.z() : 0)));
  }
}

FrameResult result_of(const PipelineConfig& config, const std::vector<float>& xyz) {
  FramePipeline pipeline(config);
  FrameResult result;
  pipeline.process(third_orientation(xyz, 0), result);
  return result;
}

// A box of 0.4 x 0.2 x 0.3 m and three that differ from it in one side, rotated by 30 degrees.
std::vector<float> four_boxes() {
  std::vector<float> xyz;
  add_box(xyz, {5, 0, 0}, {0.4, 0.2, 0.3}, M_PI / 6);
  add_box(xyz, {5, 10, 0}, {0.5, 0.2, 0.3}, M_PI / 6);
  add_box(xyz, {5, 20, 0}, {0.4, 0.1, 0.3}, M_PI / 6);
  add_box(xyz, {5, 30, 0}, {0.4, 0.2, 0.1}, M_PI / 6);
  return xyz;
}

std::vector<int> rows_of(const FrameResult& result) {  // the boxes that are left, by number
  std::vector<int> rows;
  for (std::size_t i = 0; i < result.clusters.size(); ++i)
    rows.push_back(result.clusters.list(i)[0] / 8);
  return rows;
}

TEST(ExtentLimits, AreOfTheLongerTheShorterAndTheVerticalSide) {
  const auto left = [](std::optional<UprightSize> min, std::optional<UprightSize> max) {
    PipelineConfig config = config_for();
    config.cluster.min_extent = min;
    config.cluster.max_extent = max;
    return rows_of(result_of(config, four_boxes()));
  };
  constexpr double no = std::numeric_limits<double>::infinity();
  using Rows = std::vector<int>;
  EXPECT_EQ(left({}, {}), (Rows{0, 1, 2, 3}));
  EXPECT_EQ(left(UprightSize{0.45, 0, 0}, {}), Rows{1});
  EXPECT_EQ(left(UprightSize{0, 0.15, 0}, {}), (Rows{0, 1, 3}));
  EXPECT_EQ(left(UprightSize{0, 0, 0.2}, {}), (Rows{0, 1, 2}));
  EXPECT_EQ(left({}, UprightSize{0.45, no, no}), (Rows{0, 2, 3}));
  EXPECT_EQ(left({}, UprightSize{no, 0.15, no}), Rows{2});
  EXPECT_EQ(left({}, UprightSize{no, no, 0.2}), Rows{3});
  EXPECT_EQ(left(UprightSize{0.3, 0.15, 0.2}, UprightSize{0.45, 1, 1}), Rows{0});
}

TEST(ExtentLimits, CountDroppedPointsAsSmallOrLargeAndLabelThemNone) {
  PipelineConfig config = config_for();
  config.cluster.min_extent = {0, 0.15, 0};
  config.cluster.max_extent = {0.45, 1, 1};
  const std::vector<float> xyz = four_boxes();
  const FrameResult result = result_of(config, xyz);
  EXPECT_EQ(rows_of(result), (std::vector<int>{0, 3}));
  EXPECT_EQ(result.counts.small, 8U);
  EXPECT_EQ(result.counts.large, 8U);
  EXPECT_EQ(result.clusters.small_points, 8U);
  EXPECT_EQ(result.clusters.large_points, 8U);
  const std::vector<std::uint32_t> labels = labels_of(third_orientation(xyz, 0), result);
  for (std::size_t i = 0; i < labels.size(); ++i)
    EXPECT_EQ(labels[i], i / 8 == 0 ? 0U : i / 8 == 3 ? 1U : kLabelNone) << i;
}

TEST(ExtentLimits, TooSmallComesBeforeTooLarge) {
  PipelineConfig config = config_for();
  config.cluster.min_extent = {0, 0.15, 0};
  config.cluster.max_extent = {0.3, 1, 1};
  const FrameResult result = result_of(config, four_boxes());
  EXPECT_EQ(result.clusters.size(), 0U);
  EXPECT_EQ(result.counts.small, 8U);
  EXPECT_EQ(result.counts.large, 24U);
}

TEST(ExtentLimits, ASideAtTheLimitIsAllowed) {
  std::vector<float> xyz;
  add_box(xyz, {4, 0, 0}, {0.5, 0.25, 0.125}, 0);  // exact in binary
  PipelineConfig config = config_for();
  config.cluster.min_extent = config.cluster.max_extent = {0.5, 0.25, 0.125};
  EXPECT_EQ(result_of(config, xyz).clusters.size(), 1U);
  config.cluster.min_extent->up = std::nextafter(0.125, 1);
  config.cluster.max_extent->up = 1;
  EXPECT_EQ(result_of(config, xyz).counts.small, 8U);
  config.cluster.min_extent.reset();
  config.cluster.max_extent->up = std::nextafter(0.125, 0);
  EXPECT_EQ(result_of(config, xyz).counts.large, 8U);
}

TEST(ExtentLimits, KeepTheClassesOfTheObjectsThatAreLeft) {
  const std::vector<float> xyz = four_boxes();
  Frame frame = third_orientation(xyz, 0);
  auto classes = std::make_shared<std::vector<std::int64_t>>();
  for (std::int64_t i = 0; i < 32; ++i)
    classes->push_back(10 + i / 8);
  frame.classes = classes;
  PipelineConfig config = config_for();
  config.cluster.class_field = FieldName{"label"};
  config.cluster.min_extent = {0, 0.15, 0};
  FramePipeline pipeline(config);
  FrameResult result;
  pipeline.process(frame, result);
  EXPECT_EQ(result.class_of, (std::vector<std::int64_t>{10, 11, 13}));
}

// Whether the box that obb-yaw fits to the object is within the limits: 0, -1 (small) or 1 (large).
int verdict_of(const ClusterConfig& limits, const Obb& box) {
  const Eigen::Vector3d side = 2 * box.half_extents();
  const double along = std::max(side[0], side[1]), across = std::min(side[0], side[1]);
  const UprightSize &min = *limits.min_extent, &max = *limits.max_extent;
  if (along < min.along || across < min.across || side[2] < min.up) return -1;
  return along > max.along || across > max.across || side[2] > max.up ? 1 : 0;
}

// The bounds by axis-aligned boxes only save time: the rule is that of the boxes of obb-yaw.
TEST(ExtentLimits, AgreeWithTheBoxesOfObbYawAtEveryUpDirectionAndFarFromTheOrigin) {
  std::mt19937 random(49);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t small = 0, large = 0, kept = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<float> xyz;
    const double far = round % 3 == 0 ? 5e4 : 0;
    for (int i = 0; i < 40; ++i)
      add_box(xyz, {far + 2 * i, far, 0},
              {0.5 * uniform(random), 0.5 * uniform(random), 0.5 * uniform(random)}, 6.3 * uniform(random));
    const Eigen::Vector3d ups[] = {{0, 0, 1}, {0, -1, 0}, {2, 0, 0}, {0.1, 0.2, 1}};
    PipelineConfig config = config_for(ups[round % 4]);
    const FrameResult all = result_of(config, xyz);
    config.cluster.min_extent = {0.3 * uniform(random), 0.2 * uniform(random), 0.2 * uniform(random)};
    config.cluster.max_extent = {0.35 + 0.3 * uniform(random), 0.3 + 0.3 * uniform(random),
                                 0.3 + uniform(random)};
    const FrameResult limited = result_of(config, xyz);
    std::size_t next = 0, few = 0, many = 0;
    for (std::size_t i = 0; i < all.clusters.size(); ++i) {
      const int verdict = verdict_of(config.cluster, std::get<Obb>(all.volume(i, 0)));
      few += verdict < 0 ? all.clusters.list_size(i) : 0;
      many += verdict > 0 ? all.clusters.list_size(i) : 0;
      if (verdict != 0) continue;
      ASSERT_LT(next, limited.clusters.size());
      EXPECT_EQ(limited.clusters.list(next)[0], all.clusters.list(i)[0]);
      EXPECT_TRUE(limited.volume(next, 0) == all.volume(i, 0));
      ++next;
    }
    EXPECT_EQ(next, limited.clusters.size());
    EXPECT_EQ(limited.counts.small, few);
    EXPECT_EQ(limited.counts.large, many);
    EXPECT_EQ(limited.clusters.indices.size(), limited.clusters.offsets.back());
    small += few, large += many, kept += next;
  }
  EXPECT_GT(std::min({small, large, kept}), 100U);
}

// The third component is 1 to the last bit, but the box is higher by 0.5 * 7e-9.
TEST(ExtentLimits, AreThoseOfTheBoxForAnUpDirectionNearAnAxis) {
  std::vector<float> xyz;
  add_box(xyz, {4, 0, 0}, {0.5, 0.25, 0.125}, 0);
  PipelineConfig config = config_for({7e-9, 0, 1});
  const FrameResult all = result_of(config, xyz);
  ASSERT_EQ(all.clusters.size(), 1U);
  EXPECT_GT(2 * std::get<Obb>(all.volume(0, 0)).half_extents()[2], 0.125 + 3e-9);
  config.cluster.max_extent = {1, 1, 0.125 + 1e-9};
  EXPECT_EQ(result_of(config, xyz).counts.large, 8U);
  config.cluster.max_extent->up = 0.125 + 4e-9;
  EXPECT_EQ(result_of(config, xyz).clusters.size(), 1U);
}

TEST(ExtentLimits, GiveTheSameBitsForEveryThreadCount) {
  PipelineConfig config;
  config.cluster.min_extent = {0.4, 0.2, 0.3};
  config.cluster.max_extent = {3, 2, 2};
  const std::vector<float> xyz = street(1)[0];
  const FrameResult serial = result_of(config, xyz);
  EXPECT_GT(serial.clusters.size(), 5U);
  EXPECT_GT(serial.counts.large, 0U);
  for (const std::size_t threads : {2, 3, 8}) {
    config.threads = threads;
    const FrameResult result = result_of(config, xyz);
    expect_equal(result, serial);
    EXPECT_EQ(result.counts.small, serial.counts.small);
    EXPECT_EQ(result.counts.large, serial.counts.large);
  }
}

}  // namespace
}  // namespace pcl_bv
