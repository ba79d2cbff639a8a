// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground plane on LiDAR sweeps: generated ones with their truth, and real ones of a car whose sensor is
// 1.73 m above the road.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/segmentation/ground.h"
#include "pcl_bv/synth/street.h"

namespace pcl_bv::detail {
namespace {

struct Score {
  double recall, precision;
};

Score score(const SynthCloud& cloud, const GroundSplit& split) {
  double truth = 0, right = 0;
  for (const std::uint32_t ground : cloud.ground)
    truth += ground;
  for (const std::int32_t number : split.ground)
    right += cloud.ground[static_cast<std::size_t>(number)];
  return {right / truth, right / static_cast<double>(split.ground.size())};
}

/// The sweep climbs by 5 % along x; the same with x and y swapped does so to the left.
SynthCloud turned(SynthCloud cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i)
    std::swap(cloud.xyz[3 * i], cloud.xyz[3 * i + 1]);
  return cloud;
}

TEST(GroundPlaneOnSweeps, FindsTheRoadAndSidewalksOfTheStreet) {
  GroundSplit split;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (const std::size_t frame : {0U, 7U}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", frame " + std::to_string(frame));
      StreetOptions street;
      street.seed = seed;
      const SynthCloud along = make_street_frame(street, frame).cloud;
      for (const SynthCloud& cloud : {along, turned(along)}) {
        for (const std::uint32_t search_seed : {1U, 2U, 3U}) {
          GroundPlaneOptions settings;
          settings.seed = search_seed;
          split_ground(PointView::of(cloud.xyz.data(), 12, cloud.size()), settings, split);
          ASSERT_TRUE(split.found);
          const auto [recall, precision] = score(cloud, split);
          EXPECT_GE(recall, 0.995);
          EXPECT_GE(precision, 0.96);
          EXPECT_EQ(split.ground.size() + split.rest.size(), cloud.size());
        }
      }
      EXPECT_NEAR(-split.normal.y() / split.normal.z(), street_slope, 0.005);
      const double height = -split.offset / split.normal.z();
      EXPECT_LT(height, street_sensor_height + 0.02);
      EXPECT_GT(height, street_sensor_height - street_curb_height);
    }
  }
}

TEST(GroundPlaneOnSweeps, KnowsTheSensorHeightOfRealOnes) {
  const char* const data = std::getenv("PCL_BV_DATA");
  if (!data) GTEST_SKIP() << "PCL_BV_DATA is not set";
  GroundSplit split;
  for (int frame = 0; frame < 22; ++frame) {
    const std::string number = std::to_string(frame);
    SCOPED_TRACE(number);
    const RawCloud cloud = read_pcd(std::filesystem::path(data) / "lidar_sequence" /
                                    (std::string(10 - number.size(), '0') + number + ".pcd"));
    split_ground(cloud.xyz(), {}, split);
    ASSERT_TRUE(split.found);
    EXPECT_NEAR(split.offset / split.normal.z(), -1.73, 0.08);
    EXPECT_GT(split.normal.z(), std::cos(0.05));
    double low = 0, found = 0;  // points that are road by their height alone
    const auto is_low = [&](std::size_t i) {
      const Coordinates p = load_point(cloud.xyz(), i);
      return p.z < -1.6 && p.x * p.x + p.y * p.y < 100;
    };
    for (std::size_t i = 0; i < cloud.size(); ++i)
      low += is_low(i);
    for (const std::int32_t i : split.ground)
      found += is_low(static_cast<std::size_t>(i));
    EXPECT_GT(low, 10'000);
    EXPECT_GE(found, 0.97 * low);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
