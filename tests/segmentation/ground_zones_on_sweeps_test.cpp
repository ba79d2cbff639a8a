// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground of many planes on LiDAR sweeps: precision and recall against the truth of generated ones, whose
// ground has curbs and climbs by 5 %, and the road under real ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <Eigen/Geometry>

#include "pcl_bv/io/read_cloud.h"
#include "pcl_bv/segmentation/ground.h"
#include "pcl_bv/synth/street.h"

namespace pcl_bv::detail {
namespace {

struct Score {
  double recall = 1, precision = 1;
};

Score score(const SynthCloud& cloud, const GroundSplit& split) {
  double truth = 0, right = 0;
  for (const std::uint32_t ground : cloud.ground)
    truth += ground;
  for (const std::int32_t number : split.ground)
    right += cloud.ground[static_cast<std::size_t>(number)];
  return {right / truth, right / static_cast<double>(split.ground.size())};
}

SynthCloud turned(SynthCloud cloud, const Eigen::Matrix3f& rotation) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Eigen::Map<Eigen::Vector3f> p(&cloud.xyz[3 * i]);
    p = rotation * p;
  }
  return cloud;
}

// The worst of many sweeps.
Score worst(const Eigen::Matrix3f& rotation, const GroundZonesOptions& settings = {}) {
  GroundZones zones;
  GroundSplit split;
  Score least;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const std::size_t frame : {0U, 7U}) {
      StreetOptions street;
      street.seed = seed;
      const SynthCloud cloud = turned(make_street_frame(street, frame).cloud, rotation);
      zones.split(PointView::of(cloud.xyz.data(), 12, cloud.size()), settings, split);
      EXPECT_EQ(split.ground.size() + split.rest.size(), cloud.size());
      const Score found = score(cloud, split);
      least = {std::min(least.recall, found.recall), std::min(least.precision, found.precision)};
    }
  }
  testing::Test::RecordProperty("least_recall", std::to_string(least.recall));
  testing::Test::RecordProperty("least_precision", std::to_string(least.precision));
  return least;
}

Eigen::Matrix3f about(const Eigen::Vector3f& axis, double degrees) {
  return Eigen::AngleAxisf(static_cast<float>(degrees * 0.017453292519943295), axis).toRotationMatrix();
}

const Eigen::Vector3f x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

void expect_good(const Score& least) {
  EXPECT_GE(least.recall, 0.98);
  EXPECT_GE(least.precision, 0.98);
}

TEST(GroundZonesOnSweeps, KnowTheGroundOfAStreetThatClimbs) {
  const Score least = worst(Eigen::Matrix3f::Identity());
  EXPECT_GE(least.recall, 0.995);
  EXPECT_GE(least.precision, 0.985);
}

TEST(GroundZonesOnSweeps, KnowTheGroundOfALevelStreet) {
  expect_good(worst(about(y_axis, std::atan(street_slope) * 57.29577951308232)));
}

TEST(GroundZonesOnSweeps, KnowTheGroundUnderATiltedSensor) {
  expect_good(worst(about(x_axis, 5)));
  expect_good(worst(about(y_axis, 8)));
  expect_good(worst(about(x_axis, -4) * about(y_axis, -6)));
}

TEST(GroundZonesOnSweeps, KnowTheGroundUnderATurnedSensor) {
  for (const double degrees : {37.0, 90.0, 201.0})
    expect_good(worst(about(z_axis, degrees)));
}

TEST(GroundZonesOnSweeps, KnowTheGroundAboutAnyUp) {
  for (const auto& [x, y] : {std::pair{140, 0}, std::pair{20, -35}, std::pair{0, 55}}) {
    const Eigen::Matrix3f rotation = about(y_axis, y) * about(x_axis, x);
    GroundZonesOptions settings;
    settings.up = 3 * rotation.col(2).cast<double>();
    const Score least = worst(rotation, settings);
    EXPECT_GE(least.recall, 0.995);
    EXPECT_GE(least.precision, 0.985);
  }
}

TEST(GroundZonesOnSweeps, TakeASensorHeightThatIsWrongByAHand) {
  for (const double error : {-0.3, 0.0, 0.3}) {
    GroundZonesOptions settings;
    settings.sensor_height = street_sensor_height + error;
    expect_good(worst(Eigen::Matrix3f::Identity(), settings));
  }
}

TEST(GroundZonesOnSweeps, TakeZonesThatAreNotCentredOnTheSensor) {
  GroundZonesOptions settings;
  settings.sensor = {2.5, -1, 0.5};
  expect_good(worst(Eigen::Matrix3f::Identity(), settings));
}

TEST(GroundZonesOnSweeps, KnowTheSensorHeightOfRealOnes) {
  const char* const data = std::getenv("PCL_BV_DATA");
  if (!data) GTEST_SKIP() << "PCL_BV_DATA is not set";
  GroundZones zones;
  GroundSplit split;
  for (int frame = 0; frame < 22; ++frame) {
    const std::string number = std::to_string(frame);
    SCOPED_TRACE(number);
    const RawCloud cloud = read_pcd(std::filesystem::path(data) / "lidar_sequence" /
                                    (std::string(10 - number.size(), '0') + number + ".pcd"));
    zones.split(cloud.xyz(), {}, split);
    ASSERT_TRUE(split.found);
    EXPECT_NEAR(split.offset / split.normal.z(), -1.73, 0.08);
    double low = 0, found = 0;  // points that are road by their height and place
    const auto is_low = [&](std::size_t i) {
      const Coordinates p = load_point(cloud.xyz(), i);
      return p.z < -1.6 && std::abs(p.x) < 10 && std::abs(p.y) < 3;
    };
    for (std::size_t i = 0; i < cloud.size(); ++i)
      low += is_low(i);
    for (const std::int32_t i : split.ground)
      found += is_low(static_cast<std::size_t>(i));
    EXPECT_GT(low, 10'000);
    EXPECT_GE(found, 0.98 * low);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
