// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "adapter_test.h"
#include "pcl_bv/messages/obstacles.h"
#include "pcl_bv/messages/polygon.h"

namespace pcl_bv::test {
namespace {

using msg::Obstacle;
using msg::ObstacleArray;
using msg::Point32;
using msg::PolygonInstanceStamped;
using msg::PolygonStamped;

const Eigen::Vector3d kCube{8, 3, 0}, kOther{5, 0, 0};  // the nearest one last, as the polygons

class Nav2 : public testing::Test {
 protected:
  std::vector<Obstacle> obstacles(const std::vector<Eigen::Vector3d>& centres) {
    cubes.process(centres);
    adapter->write(cubes.frame, cubes.result);
    const auto arrays = sent.take<ObstacleArray>("/bv/obstacles");
    EXPECT_EQ(arrays.size(), 1U);
    if (arrays.empty()) return {};
    EXPECT_EQ(arrays[0].header.frame_id, "base");
    EXPECT_EQ(msg::nanoseconds_of(arrays[0].header.stamp), cubes.frame.header.stamp_ns);
    return arrays[0].obstacles;
  }

  Cubes cubes{{"sphere", "aabb", "obb-lshape"}};
  Sent sent;
  std::unique_ptr<MessageAdapter> adapter = make_nav2_adapter(sent, "/bv");
};

TEST_F(Nav2, ObstacleHasTheBoxThatAllItsVolumesShare) {
  const std::vector<Obstacle> all = obstacles({kCube, kOther});
  ASSERT_EQ(all.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Aabb& box = std::get<Aabb>(cubes.result.volume(i, 1));  // the sphere's box is larger
    EXPECT_EQ(all[i].score, 1);
    EXPECT_EQ(all[i].position.x, box.center().x());
    EXPECT_EQ(all[i].position.z, box.center().z());
    EXPECT_EQ(all[i].size.x, box.max().x() - box.min().x());
    EXPECT_EQ(all[i].size.y, box.max().y() - box.min().y());
  }
}

TEST_F(Nav2, ObstacleHasTheMotionOfItsTrack) {
  std::vector<Obstacle> all;
  for (int i = 0; i < 8; ++i)
    all = obstacles({kCube + Eigen::Vector3d(0.2 * i, 0.1 * i, 0)});
  ASSERT_EQ(all.size(), 1U);
  const TrackEntry& track = *cubes.result.tracks.at(0);
  EXPECT_EQ(all[0].velocity.x, track.velocity.x());
  EXPECT_EQ(all[0].velocity.y, track.velocity.y());
  EXPECT_NEAR(all[0].velocity.x, 2, 0.3);
  EXPECT_EQ(all[0].position_covariance[0], track.covariance[0]);
  EXPECT_EQ(all[0].position_covariance[4], track.covariance[6]);
  EXPECT_EQ(all[0].position_covariance[8], track.covariance[11]);
  EXPECT_EQ(all[0].velocity_covariance[0], track.covariance[18]);
  EXPECT_EQ(all[0].velocity_covariance[4], track.covariance[20]);
  EXPECT_EQ(all[0].velocity_covariance[8], std::max(track.covariance[18], track.covariance[20]));
}

// The sensor looks to the left of the fixed frame: what moves along the fixed y moves along its x.
TEST_F(Nav2, VelocityIsAlongTheAxesOfTheHeaderAlsoWithPoses) {
  cubes.process({kCube});
  cubes.result.tracks.at(0)->velocity = {0, 3, 1};
  cubes.result.tracks.at(0)->covariance = {};
  cubes.result.tracks.at(0)->covariance[18] = 4;  // of vx in the fixed frame
  cubes.result.tracks.at(0)->covariance[20] = 9;
  cubes.frame.pose = Pose::Identity();
  cubes.frame.pose->linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  adapter->write(cubes.frame, cubes.result);
  const Obstacle found = sent.take<ObstacleArray>("/bv/obstacles").at(0).obstacles.at(0);
  EXPECT_EQ((std::array{found.velocity.x, found.velocity.y, found.velocity.z}), (std::array{3.0, 0.0, 1.0}));
  EXPECT_EQ(found.velocity_covariance, (std::array<double, 9>{9, 0, 0, 0, 4, 0, 0, 0, 9}));
}

TEST_F(Nav2, UuidIsThatOfTheTrack) {
  const std::vector<Obstacle> first = obstacles({kCube, kOther});
  ASSERT_EQ(first.size(), 2U);
  EXPECT_NE(first[0].uuid, first[1].uuid);
  EXPECT_EQ(first[0].uuid[6] >> 4, 8);  // version 8 of the variant of RFC 9562
  EXPECT_EQ(first[0].uuid[8] >> 6, 2);
  EXPECT_TRUE(obstacles({}).empty());
  const std::vector<Obstacle> again = obstacles({kCube});  // a track that comes back
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0].uuid, first[0].uuid);
  for (int i = 0; i < 3; ++i)
    obstacles({});
  const std::vector<Obstacle> later = obstacles({kCube});  // after the track ended
  ASSERT_EQ(later.size(), 1U);
  EXPECT_NE(later[0].uuid, first[0].uuid);
}

TEST_F(Nav2, ObstacleWithoutATrackHasUnknownCovariancesAndAnotherUuid) {
  const auto tracked = obstacles({kCube}).at(0).uuid;
  cubes.result.tracks.at(0).reset();
  adapter->write(cubes.frame, cubes.result);
  const Obstacle found = sent.take<ObstacleArray>("/bv/obstacles").at(0).obstacles.at(0);
  EXPECT_NE(found.uuid, tracked);
  EXPECT_EQ(found.position_covariance[0], -1);
  EXPECT_EQ(found.velocity_covariance[0], -1);
  EXPECT_EQ(found.velocity.x, 0);
}

TEST_F(Nav2, NumbersThatAreNotFiniteNeverLeave) {
  cubes.process({kCube, kOther});
  const double huge = std::numeric_limits<double>::max();
  for (std::size_t m = 0; m < 3; ++m)
    cubes.result.volumes[m] = Aabb({-huge, 0, 0}, {huge, 1, 1});
  cubes.result.tracks.at(1)->velocity.x() = std::numeric_limits<double>::quiet_NaN();
  adapter->write(cubes.frame, cubes.result);
  EXPECT_TRUE(sent.take<ObstacleArray>("/bv/obstacles").at(0).obstacles.empty());
  const auto polygons = sent.take<PolygonInstanceStamped>("/bv/polygons");
  ASSERT_EQ(polygons.size(), 1U);
  EXPECT_EQ(polygons[0].polygon.id, cubes.result.tracks[1]->id);
}

TEST_F(Nav2, EmptyCloudGivesNoObstaclesAndNoPolygons) {
  EXPECT_TRUE(obstacles({}).empty());
  EXPECT_TRUE(sent.take<PolygonInstanceStamped>("/bv/polygons").empty());
  EXPECT_TRUE(sent.take<PolygonStamped>("/bv/footprints").empty());
}

// The area of a polygon, counter-clockwise seen from above.
double area(const std::vector<Point32>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point32 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice += static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x;
  }
  return twice / 2;
}

double outside(const std::vector<Point32>& corners, double x, double y) {
  double farthest = -1e9;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point32 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double ex = b.x - a.x, ey = b.y - a.y;
    farthest = std::max(farthest, (ey * (x - a.x) - ex * (y - a.y)) / std::hypot(ex, ey));
  }
  return farthest;
}

TEST_F(Nav2, PolygonIsTheFootprintOfTheBoxAndHasTheIdOfTheTrack) {
  cubes.process({kCube, kOther});
  adapter->write(cubes.frame, cubes.result);
  const auto polygons = sent.take<PolygonInstanceStamped>("/bv/polygons");
  const auto footprints = sent.take<PolygonStamped>("/bv/footprints");
  ASSERT_EQ(polygons.size(), 2U);
  ASSERT_EQ(footprints.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Aabb& box = std::get<Aabb>(cubes.result.volume(i, 1));
    const std::vector<Point32>& corners = polygons[i].polygon.polygon.points;
    EXPECT_EQ(polygons[i].header.frame_id, "base");
    EXPECT_EQ(polygons[i].polygon.id, cubes.result.tracks[i]->id);
    ASSERT_EQ(corners.size(), 4U);
    EXPECT_NEAR(area(corners), (box.max() - box.min()).head<2>().prod(), 1e-5);
    for (const Point32& corner : corners)
      EXPECT_NEAR(corner.z, box.min().z(), 1e-6);
    ASSERT_EQ(footprints[i].polygon.points.size(), 4U);
    EXPECT_EQ(footprints[i].polygon.points[2].x, corners[2].x);
    EXPECT_EQ(footprints[i].header.stamp.nanosec, polygons[i].header.stamp.nanosec);
  }
}

TEST_F(Nav2, PolygonIsClearedWhenItsTrackEnds) {
  const auto changes = [&](const std::vector<Eigen::Vector3d>& centres) {
    cubes.process(centres);
    adapter->write(cubes.frame, cubes.result);
    std::vector<std::pair<std::int64_t, std::size_t>> all;  // id, corners
    for (const PolygonInstanceStamped& polygon : sent.take<PolygonInstanceStamped>("/bv/polygons"))
      all.emplace_back(polygon.polygon.id, polygon.polygon.polygon.points.size());
    return all;
  };
  using testing::ElementsAre;
  using testing::Pair;
  ASSERT_EQ(changes({kCube, kOther}).size(), 2U);
  const std::int64_t cube = cubes.result.tracks[0]->id, other = cubes.result.tracks[1]->id;
  for (int i = 0; i < 2; ++i)
    EXPECT_THAT(changes({kCube}), ElementsAre(Pair(cube, 4U)));  // the other track has not ended
  EXPECT_THAT(changes({kCube}), ElementsAre(Pair(cube, 4U), Pair(other, 0U)));
  EXPECT_THAT(changes({kCube}), ElementsAre(Pair(cube, 4U)));
}

TEST_F(Nav2, NearestPolygonIsTheLast) {
  const std::vector<Eigen::Vector3d> centres{{9, 0, 0}, {4, 0, 0}, {0, -6, 0}, {0, 12, 0}};
  cubes.process(centres);
  adapter->write(cubes.frame, cubes.result);
  double last = 1e9;
  const auto polygons = sent.take<PolygonInstanceStamped>("/bv/polygons");
  ASSERT_EQ(polygons.size(), 4U);
  for (const PolygonInstanceStamped& polygon : polygons) {
    const Point32& corner = polygon.polygon.polygon.points.at(0);
    const double distance = std::hypot(corner.x, corner.y);
    EXPECT_LT(distance, last);
    last = distance;
  }
}

TEST(Nav2Footprints, ContainThePointsOfTiltedBoxesAndPrisms) {
  for (const char* volume : {"obb-min", "sphere", "prism"}) {
    SCOPED_TRACE(volume);
    Cubes cubes({volume});
    Sent sent;
    const auto adapter = make_nav2_adapter(sent, "");
    cubes.process({kOther});
    adapter->write(cubes.frame, cubes.result);
    const auto polygons = sent.take<PolygonInstanceStamped>("/polygons");
    ASSERT_EQ(polygons.size(), 1U);
    const std::vector<Point32>& corners = polygons[0].polygon.polygon.points;
    EXPECT_GT(corners.size(), 3U);
    double farthest = -1e9;
    for (std::size_t i = 0; i < cubes.xyz.size(); i += 3)
      farthest = std::max(farthest, outside(corners, cubes.xyz[i], cubes.xyz[i + 1]));
    EXPECT_LE(farthest, 1e-6);  // floats
  }
}

TEST(Nav2Footprints, OfObjectsWithoutTracksHaveNegativeIds) {
  Cubes cubes({"aabb"});
  cubes.config.track.enabled = false;
  Sent sent;
  const auto adapter = make_nav2_adapter(sent, "");
  cubes.process({kCube, kOther});
  adapter->write(cubes.frame, cubes.result);
  const auto polygons = sent.take<PolygonInstanceStamped>("/polygons");
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_EQ(polygons[0].polygon.id, -1);
  EXPECT_EQ(polygons[1].polygon.id, -2);
}

TEST(Nav2Footprints, AreTheOnlyMessagesOfRos1) {
  Cubes cubes({"aabb"});
  Sent sent;
  sent.ros1 = true;
  const auto adapter = make_nav2_adapter(sent, "");
  ASSERT_EQ(sent.topics.size(), 1U);
  cubes.process({kCube});
  adapter->write(cubes.frame, cubes.result);
  EXPECT_EQ(sent.take<PolygonStamped>("/footprints").size(), 1U);
}

}  // namespace
}  // namespace pcl_bv::test
