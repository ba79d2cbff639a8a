// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds whose frame does not begin at the sensor, or that are upside down: a street's ground is the same
// wherever its frame is, or it is said that it may not be.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pcl_bv/segmentation/ground.h"
#include "pcl_bv/synth/street.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;

/// Returns of a street, and which of them are ground.
struct Street {
  std::vector<Vector3d> points;
  std::vector<bool> ground;

  PointView view() const { return PointView::of(points.data()->data(), sizeof(Vector3d), points.size()); }

  template <typename Move>
  Street moved(const Move& move) const {
    Street other = *this;
    for (Vector3d& p : other.points)
      p = move(p);
    return other;
  }
};

Street street(std::uint64_t seed = 2) {
  const SynthCloud cloud = make_street_frame({60'000, seed}, 0).cloud;
  Street found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector3d p(cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]);
    if (p.squaredNorm() < 1) continue;
    found.points.push_back(p);
    found.ground.push_back(cloud.ground[i] != 0);
  }
  return found;
}

GroundSplit split(const Street& cloud, const GroundZonesOptions& settings = {}) {
  GroundSplit found;
  GroundZones().split(cloud.view(), settings, found);
  return found;
}

void expect_right(const Street& cloud, const GroundSplit& found) {
  double right = 0, truth = 0;
  for (const std::int32_t i : found.ground)
    right += cloud.ground[static_cast<std::size_t>(i)];
  for (const bool ground : cloud.ground)
    truth += ground;
  EXPECT_GE(right / static_cast<double>(found.ground.size()), 0.98);
  EXPECT_GE(right / truth, 0.98);
}

SensorPosition place_in(const Street& cloud, const Vector3d& up = {0, 0, 1},
                        const Vector3d& said = {0, 0, 0}) {
  GroundScratch scratch;
  return find_sensor(cloud.view(), up, said, scratch);
}

TEST(SensorPosition, AStreetHasTheSameGroundWhereverItsFrameBegins) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Street cloud = street(seed);
    for (const double metres : {5.0, 20.0, 40.0, 70.0, 100.0, 200.0, 5e6}) {
      for (const Vector3d& way : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 1, 0),
                                  Vector3d(0, -1, 0), Vector3d(0.6, 0.8, 0.01)}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << metres << " m, " << way.transpose());
        const Vector3d origin = metres * way;
        const Street other = cloud.moved([&](const Vector3d& p) { return Vector3d(p + origin); });
        const GroundSplit found = split(other);
        expect_right(other, found);
        if (metres < 40) continue;
        EXPECT_FALSE(found.sensor.confirmed);
        EXPECT_LT((found.sensor.position - origin).head<2>().norm(), 5);
      }
    }
  }
}

TEST(SensorPosition, IsTheOriginToTheBitWhereThePointsLieAroundIt) {
  const Street cloud = street();
  const GroundSplit found = split(cloud);
  EXPECT_TRUE(found.sensor.confirmed);
  EXPECT_EQ(found.sensor.position, Vector3d(0, 0, 0));
  GroundZonesOptions settings;
  settings.sensor = Vector3d(0, 0, 0);
  EXPECT_EQ(split(cloud, settings).ground, found.ground);
}

TEST(SensorPosition, ThatIsGivenIsBelieved) {
  GroundZonesOptions settings;
  settings.sensor = Vector3d(150, 0, 0);
  EXPECT_EQ(split(street(), settings).sensor.position, Vector3d(150, 0, 0));
}

TEST(SensorPosition, RaysWithoutAReturnAreNoPointsAroundTheOrigin) {
  Street cloud = street().moved([](const Vector3d& p) { return Vector3d(p + Vector3d(100, 0, 0)); });
  for (std::size_t i = 0; i < 40'000; ++i)
    cloud.points.emplace_back(0, 0, 0);
  const SensorPosition place = place_in(cloud);
  EXPECT_FALSE(place.confirmed);
  EXPECT_NEAR(place.position.x(), 100, 5);
}

TEST(SensorPosition, ASensorThatLooksAheadHasItsPointsAroundIt) {
  const Street all = street();
  Street ahead;
  for (const Vector3d& p : all.points) {
    if (p.x() > 8 && std::abs(p.y()) < p.x()) ahead.points.push_back(p);
  }
  ASSERT_GT(ahead.points.size(), 1000U);
  EXPECT_TRUE(place_in(ahead).confirmed);
}

TEST(SensorPosition, ASensorHighUpHasItsPointsAroundIt) {  // its first ring of ground is 15 m away
  Street plain;
  for (int ring = 0; ring < 8; ++ring) {
    for (int i = 0; i < 1800; ++i)
      plain.points.emplace_back((15 + 4 * ring * ring) * std::cos(i / 286.5),
                                (15 + 4 * ring * ring) * std::sin(i / 286.5), -4);
  }
  EXPECT_TRUE(place_in(plain).confirmed);
}

TEST(SensorPosition, FewPointsAreAroundAnyPlace) {
  Street few;
  few.points.assign(99, Vector3d(500, 0, 0));
  EXPECT_TRUE(place_in(few).confirmed);
  few.points.resize(100, Vector3d(500, 0, 0));
  EXPECT_FALSE(place_in(few).confirmed);
  EXPECT_TRUE(place_in(Street()).confirmed);
}

TEST(SensorPosition, IsSoughtAcrossUp) {
  const Street cloud = street().moved([](const Vector3d& p) { return Vector3d(p.y(), 80 - p.z(), -p.x()); });
  EXPECT_TRUE(place_in(cloud, {0, -1, 0}).confirmed);
  const Street aside = cloud.moved([](const Vector3d& p) { return Vector3d(p + Vector3d(0, 0, 90)); });
  const SensorPosition place = place_in(aside, {0, -1, 0});
  EXPECT_FALSE(place.confirmed);
  EXPECT_NEAR(place.position.z(), 90, 5);
  EXPECT_EQ(place.position.y(), 0);
}

TEST(SensorPosition, SaysHowManyPointsAreBeyondTheRings) {
  Street field;  // 600 x 600 m, as from an aeroplane
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 200; ++j)
      field.points.emplace_back(3 * i - 300, 3 * j - 300, 0);
  }
  EXPECT_NEAR(place_in(field).far_share, 1 - 3.1416 * 100 * 100 / (600 * 600), 0.03);
  EXPECT_LT(place_in(street()).far_share, 0.02);
}

TEST(SensorPosition, ThatIsNotFiniteIsRefused) {
  const double nan = std::nan("");
  EXPECT_THROW(place_in(street(), {0, 0, 1}, {nan, 0, 0}), std::invalid_argument);
  EXPECT_THROW(place_in(street(), {0, 0, 0}), std::invalid_argument);
}

TEST(SensorPosition, AHeightThatFitsNoPlaneIsToldFromOneThatDoes) {
  GroundZonesOptions settings;
  settings.sensor_height = 1.7;
  EXPECT_FALSE(split(street(), settings).assumed_level);
  settings.sensor_height = 6;
  EXPECT_TRUE(split(street(), settings).assumed_level);
}

TEST(SensorPosition, AHeightIsOfNoUseWhereThePlaceIsEstimated) {
  GroundZonesOptions settings;
  settings.sensor_height = 1.7;
  const Street high = street().moved([](const Vector3d& p) { return Vector3d(p + Vector3d(300, 0, 120)); });
  const GroundSplit found = split(high, settings);
  EXPECT_FALSE(found.assumed_level);
  expect_right(high, found);
}

std::optional<OtherUp> other_up(const Street& cloud, const Vector3d& up, double found) {
  GroundPlaneOptions settings;
  settings.up = up;
  return find_other_up(cloud.view(), settings, {0, 0, 0}, found);
}

TEST(OtherUp, OfAStreetUpsideDownIsTheOpposite) {
  const Street down = street().moved([](const Vector3d& p) { return Vector3d(p.x(), -p.y(), -p.z()); });
  const double share =
      static_cast<double>(split(down).ground.size()) / static_cast<double>(down.points.size());
  const auto other = other_up(down, {0, 0, 1}, share);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->up, Vector3d(0, 0, -1));
  EXPECT_NEAR(other->share, 0.5, 0.05);
}

TEST(OtherUp, OfAStreetThatStandsIsNone) {
  EXPECT_FALSE(other_up(street(), {0, 0, 1}, 0.49));
  EXPECT_FALSE(other_up(street(), {0, 0, 1}, 0.1));
  EXPECT_FALSE(other_up(street(), {0, 0, 1}, 0));
}

TEST(OtherUp, OfACamerasFrameIsMinusY) {
  const Street camera = street().moved([](const Vector3d& p) { return Vector3d(-p.y(), -p.z(), p.x()); });
  const auto other = other_up(camera, {0, 0, 1}, 0);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->up, Vector3d(0, -1, 0));
  EXPECT_FALSE(other_up(camera, {0, 0, 1}, 0.1)) << "walls are no ground where some is found";
}

TEST(OtherUp, OfOneWallIsNone) {
  Street wall;
  for (int i = 0; i < 2000; ++i)
    wall.points.emplace_back(3, 0.1 * (i % 40), 0.1 * (i / 40));
  EXPECT_FALSE(other_up(wall, {0, 0, 1}, 0));
}

TEST(OtherUp, IsNoneWhereThePlaneIsAtTheSensor) {
  Street flat;
  for (int i = 0; i < 2000; ++i)
    flat.points.emplace_back(i % 40 - 20, i / 40 - 25, 0.001 * (i % 7));
  EXPECT_FALSE(other_up(flat, {0, 0, 1}, 0.05));
}

}  // namespace
}  // namespace pcl_bv::detail
