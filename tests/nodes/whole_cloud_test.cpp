// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The pipeline for clouds that are one object, in memory or not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "flush_to_zero.h"
#include "frames.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/io/raw_cloud.h"
#include "pcl_bv/messages/types.h"
#include "pcl_bv/nodes/frame_pipeline.h"
#include "pcl_bv/nodes/topics.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/report/picture.h"
#include "pcl_bv/trees/region_mask.h"

namespace pcl_bv::detail {
namespace {

Frame with(const PointView& points) {
  Frame frame;
  frame.points = points;
  return frame;
}

FrameResult result_of(const PipelineConfig& config, const PointView& points) {
  FrameResult result;
  FramePipeline(config).process(with(points), result);
  return result;
}

std::vector<float> street_with_bad_points() {
  std::vector<float> xyz = street(1, 64'000)[0];
  for (std::size_t i = 0; i < xyz.size(); i += 1000)
    xyz[i] = std::numeric_limits<float>::quiet_NaN();
  return xyz;
}

TEST(WholeCloud, FromASourceHasTheBitsOfTheSameInMemory) {
  const std::vector<float> xyz = street_with_bad_points();
  const AskedFor source(xyz);
  for (const double range_min : {0.0, 3.0}) {
    PipelineConfig config = whole_cloud_config();
    config.filter.range_min = range_min;
    config.volumes = {"aabb", "dop26", "sphere", "obb-pca", "obb-min"};
    const FrameResult held = result_of(config, third_orientation(xyz, 0).points);
    const FrameResult asked = result_of(config, source.view());
    EXPECT_EQ(held.volumes, asked.volumes) << range_min;
    EXPECT_EQ(held.counts.nonfinite, (xyz.size() + 999) / 1000);
    EXPECT_EQ(held.counts.range, asked.counts.range);
    EXPECT_EQ(held.counts.range > 0, range_min > 0);
    ASSERT_EQ(held.clusters.size(), 1U);
    EXPECT_EQ(held.clusters.list_size(0), held.points - held.counts.nonfinite - held.counts.range);
    EXPECT_EQ(asked.clusters.offsets, held.clusters.offsets);
  }
}

// One cluster is fitted by the calling thread itself, of several all but one in a parallel region. Only the largest of
// three is of denormal size.
TEST(WholeCloud, OfDenormalSizeHasTheSameBitsOnAHostThatFlushesDenormals) {
  std::vector<float> xyz;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int i = 0; i < 900; ++i)
    xyz.push_back(1e-41F * unit(random));
  for (int i = 0; i < 450; ++i)
    xyz.push_back((i < 300 ? 10.0F : 20.0F) + 0.1F * unit(random));
  for (const double tolerance : {0.0, 0.5}) {
    PipelineConfig config = whole_cloud_config();
    config.filter.range_min = 0;
    config.cluster.tolerance = tolerance;
    config.volumes = {"sphere", "obb-min", "dop26", "capsule"};
    const PointView cloud = third_orientation(xyz, 0).points;
    const FrameResult expected = result_of(config, cloud);
    ASSERT_EQ(expected.clusters.size(), tolerance > 0 ? 3U : 1U);
    FrameResult flushed;
    {
      const test::FlushToZero host;
      flushed = result_of(config, cloud);
    }
    EXPECT_EQ(flushed.volumes, expected.volumes) << tolerance;
    EXPECT_GT(std::get<Sphere>(flushed.volumes[0]).radius(), 0);
  }
}

TEST(WholeCloud, PointsOfItAreThoseThatItsVolumesHold) {
  const std::vector<float> street_xyz = street_with_bad_points();
  const std::vector<float> few(street_xyz.begin(), street_xyz.begin() + 3000);
  for (const std::vector<float>* xyz : {&street_xyz, &few}) {  // as they come past, and by a list
    PipelineConfig config = whole_cloud_config();
    config.filter.range_min = 4;
    config.filter.range_max = 30;
    const PointView cloud = third_orientation(*xyz, 0).points;
    const FrameResult result = result_of(config, cloud);
    EXPECT_EQ(result.filtered != nullptr, xyz == &street_xyz);
    ASSERT_EQ(result.clusters.size(), 1U);
    const PointView points = result.points_of(0, cloud);
    for (std::size_t m = 0; m < result.methods.size(); ++m) {
      const Verification proof = verify(result.volume(0, m), points);
      EXPECT_EQ(proof.checked, result.clusters.list_size(0));
      EXPECT_EQ(proof.outside, 0U);
    }
    EXPECT_GT(verify(result.volume(0, 0), cloud).outside, 0U);  // the filter has dropped some
    const std::vector<std::uint32_t> labels = labels_of(with(cloud), result);
    EXPECT_EQ(std::count(labels.begin(), labels.end(), 0U),
              static_cast<std::ptrdiff_t>(result.clusters.list_size(0)));
  }
}

TEST(Regions, DropWhatIsInsideOrOutsideAndCountIt) {
  const std::vector<float> xyz = street_with_bad_points();
  const PointView cloud = third_orientation(xyz, 0).points;
  const AnyVolume box = Aabb({-5, -5, -2}, {5, 5, 2}), ball = Sphere({8, 0, 0}, 3);
  const Region grown_box{box, 0.5}, grown_ball{ball, 0.5};
  const RegionMask mask({grown_box, grown_ball});
  std::vector<std::uint8_t> inside;
  mask.mark(cloud, inside);
  const auto within = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1));
  const std::size_t valid = cloud.count - (xyz.size() + 999) / 1000;
  ASSERT_GT(within, 100U);
  for (const bool keep : {false, true}) {
    for (const double tolerance : {0.0, 0.5}) {  // as they come past, and by lists
      PipelineConfig config = whole_cloud_config();
      config.cluster.tolerance = tolerance;
      config.cluster.min_size = 1;
      config.filter.regions = {{"", keep, 0.5, {box}}, {"", keep, 0.5, {ball}}};
      const FrameResult result = result_of(config, cloud);
      EXPECT_EQ(result.counts.inside, keep ? valid - within : within);
      std::size_t left = 0;
      for (std::size_t c = 0; c < result.clusters.size(); ++c)
        left += result.clusters.list_size(c);
      EXPECT_EQ(left, keep ? within : valid - within);
      const std::vector<std::uint32_t> labels = labels_of(with(cloud), result);
      for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == kLabelNone) continue;
        ASSERT_EQ(inside[i] != 0, keep) << i;
      }
    }
  }
}

TEST(WholeCloud, ASliceIsToldApartByTheNumbersOfItsCloud) {
  const std::vector<float> xyz = street(1, 64'000)[0];
  const PointView cloud = third_orientation(xyz, 0).points;
  const PointView slice = cloud.slice(20'000, cloud.count - 20'000);
  PipelineConfig config = whole_cloud_config();
  config.cluster.tolerance = 0.5;
  config.filter.range_min = 1;
  const FrameResult result = result_of(config, slice);
  ASSERT_GE(result.clusters.size(), 1U);
  for (std::size_t c = 0; c < result.clusters.size(); ++c) {
    const PointView points = result.points_of(c, slice);
    EXPECT_EQ(verify(result.volume(c, 0), points).outside, 0U);
    for (std::size_t i = 0; i < points.count; ++i) {
      const Coordinates p = load_point(points, i), q = load_point(cloud, points.index(i));
      ASSERT_TRUE(p == q) << points.index(i);
    }
  }
}

TEST(WholeCloud, APartOfItIsFilteredAsItComesPastByTheNumbersOfItsCloud) {
  const std::vector<float> xyz = street_with_bad_points();
  const AskedFor source(xyz);
  for (const PointView& cloud : {PointView::of(xyz.data(), 12, xyz.size() / 3), source.view()}) {
    const std::size_t first = 20'000;
    const PointView slice = cloud.slice(first, cloud.count - first - 5000);
    ASSERT_GT(slice.count, kChunkPoints);
    PipelineConfig config = whole_cloud_config();
    config.filter.range_min = 5;
    const FrameResult result = result_of(config, slice);
    ASSERT_TRUE(result.filtered);
    const std::vector<std::uint32_t> labels = labels_of(with(slice), result);
    ASSERT_EQ(labels.size(), first + slice.count);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const double x = xyz[3 * i], y = xyz[3 * i + 1], z = xyz[3 * i + 2];
      ASSERT_EQ(labels[i] == 0, i >= first && x * x + y * y + z * z >= 25) << i;
    }
  }
}

TEST(WholeCloud, ThatIsFilteredAsItComesPastLivesAsLongAsItsResult) {
  auto xyz = std::make_shared<std::vector<float>>(street(1, 64'000)[0]);
  Frame frame = with(PointView::of(xyz->data(), 12, xyz->size() / 3));
  frame.owner = xyz;
  const std::weak_ptr<const std::vector<float>> alive = xyz;
  xyz.reset();
  PipelineConfig config = whole_cloud_config();
  config.filter.range_min = 5;
  FrameResult result;
  FramePipeline(config).process(frame, result);
  const PointView points = frame.points;
  frame = Frame();
  ASSERT_FALSE(alive.expired());
  EXPECT_EQ(verify(result.volume(0, 0), result.points_of(0, points)).outside, 0U);
  result = FrameResult();
  EXPECT_TRUE(alive.expired());
}

TEST(WholeCloud, PointsAtTheEndOfTheFloatsAreTrackedLikeOthers) {
  std::vector<float> xyz;
  for (int i = 0; i < 60; ++i)
    xyz.insert(xyz.end(), {i < 30 ? 3e38F : 5.0F, 0.01F * static_cast<float>(i), 0});
  PipelineConfig config = whole_cloud_config();
  config.cluster.tolerance = 0.5;
  config.track.enabled = true;
  FramePipeline pipeline(config);
  FrameResult result;
  for (std::size_t f = 0; f < 5; ++f)
    pipeline.process(third_orientation(xyz, f), result);
  EXPECT_EQ(result.tracks.size(), result.clusters.size());
}

TEST(Regions, AFileThatCannotBeReadIsAnErrorBeforeAnyFrame) {
  PipelineConfig config;
  config.filter.regions = {{"/nonexistent.json"}};
  EXPECT_THROW(FramePipeline{config}, IoError);
  config.filter.regions = {{"/nonexistent.json", false, -1}};
  EXPECT_THROW(FramePipeline{config}, std::invalid_argument);
}

TEST(WholeCloud, ThatIsNotInMemoryCannotBeToldApart) {
  const std::vector<float> xyz = street(1, 64'000)[0];
  const AskedFor source(xyz);
  PipelineConfig config = whole_cloud_config();
  config.cluster.tolerance = 0.5;
  EXPECT_THROW(result_of(config, source.view()), std::invalid_argument);
  config = whole_cloud_config();
  config.ground.method = GroundMethod::plane;
  EXPECT_THROW(result_of(config, source.view()), std::invalid_argument);
}

TEST(WholeCloud, HeedsTheSizesThatAreAllowed) {
  const std::vector<float> xyz{1, 0, 0, 2, 0, 0, 3, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0};
  const auto sized = [&](std::size_t least, std::size_t most) {
    PipelineConfig config = whole_cloud_config();
    config.cluster.min_size = least;
    config.cluster.max_size = most;
    return result_of(config, third_orientation(xyz, 0).points);
  };
  EXPECT_EQ(sized(3, 3).clusters.size(), 1U);
  const FrameResult small = sized(4, 9), large = sized(0, 2);
  EXPECT_EQ(small.clusters.size(), 0U);
  EXPECT_EQ(small.counts.small, 3U);
  EXPECT_EQ(small.counts.nonfinite, 1U);
  EXPECT_EQ(large.clusters.size(), 0U);
  EXPECT_EQ(large.counts.large, 3U);
}

TEST(WholeCloud, WithoutAValidPointIsOneEmptyObject) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::vector<float>& xyz : {std::vector<float>{}, {nan, 0, 0}}) {
    const PointView cloud = third_orientation(xyz, 0).points;
    const FrameResult result = result_of(whole_cloud_config(), cloud);
    ASSERT_EQ(result.clusters.size(), 1U);
    EXPECT_EQ(result.points_of(0, cloud).count, 0U);
    EXPECT_TRUE(empty(result.volume(0, 0)));
    EXPECT_EQ(result.counts.nonfinite, xyz.size() / 3);
  }
}

TEST(GroundPlace, ZonesStandAboutTheSensorWhereverItIs) {
  std::vector<float> xyz = street(1, 64'000)[0], moved = xyz;
  for (std::size_t i = 0; i < xyz.size(); ++i)
    moved[i] += i % 3 == 0 ? 64.0F : 0.0F;  // but for rounding the same street
  PipelineConfig config = whole_cloud_config();
  config.ground.method = GroundMethod::zones;
  const std::size_t ground = result_of(config, third_orientation(xyz, 0).points).counts.ground;
  config.ground.sensor = Eigen::Vector3d(64, 0, 0);
  const std::size_t found = result_of(config, third_orientation(moved, 0).points).counts.ground;
  config.ground.sensor.reset();
  const FrameResult without = result_of(config, third_orientation(moved, 0).points);
  EXPECT_LT(std::abs(static_cast<double>(found) - static_cast<double>(ground)),
            0.001 * static_cast<double>(ground));
  EXPECT_FALSE(without.sensor.confirmed);
  EXPECT_NEAR(without.sensor.position.x(), 64, 5);
  EXPECT_LT(std::abs(static_cast<double>(without.counts.ground) - static_cast<double>(ground)),
            0.01 * static_cast<double>(ground));
}

TEST(StreamHealth, SaysTheFirstWarningOfTheSettingsInForce) {
  std::vector<float> moved = street(1, 64'000)[0];
  for (std::size_t i = 0; i < moved.size(); i += 3)
    moved[i] += 100;
  PipelineConfig config = whole_cloud_config();
  config.ground.method = GroundMethod::zones;
  const Frame frame = third_orientation(moved, 0);
  StreamHealth health;
  EXPECT_TRUE(health.record_frame(frame, result_of(config, frame.points)));
  msg::DiagnosticArray array;
  health.fill(frame, array);
  EXPECT_EQ(array.status.front().level, msg::DiagnosticStatus::WARN);
  EXPECT_THAT(array.status.front().message, testing::HasSubstr("do not lie around the origin"));
  config.ground.sensor = Eigen::Vector3d(100, 0, 0);
  health.record_frame(frame, result_of(config, frame.points));
  health.fill(frame, array);
  EXPECT_EQ(array.status.front().message, "running");
}

TEST(GroundRemark, SaysWhenThereIsNoGroundOrNothingElse) {
  auto config = std::make_shared<PipelineConfig>();
  config->ground.method = GroundMethod::plane;
  FrameResult result;
  result.config = config;
  result.points = 120;
  result.counts.range = 20;
  EXPECT_THAT(ground_warning(result), testing::HasSubstr("no ground found (up is z): try ground.up"));
  result.counts.ground = 100;
  EXPECT_THAT(ground_warning(result), testing::HasSubstr("all points were classified as ground"));
  result.counts.ground = 99;
  EXPECT_EQ(ground_warning(result), "");
  result.counts.ground = 0;
  result.counts.range = 21;  // of 99 points
  EXPECT_EQ(ground_warning(result), "");
  result.counts.range = 20;
  config->ground.method = GroundMethod::none;
  EXPECT_EQ(ground_warning(result), "");
}

}  // namespace
}  // namespace pcl_bv::detail
