// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground of many planes under any up.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "ground_scenes.h"
#include "pcl_bv/segmentation/ground.h"

namespace pcl_bv::detail {
namespace {

GroundSplit split(const PointView& points, const GroundZonesOptions& settings = {}) {
  GroundSplit result;
  GroundZones().split(points, settings, result);
  return result;
}

double hill(double x, double) {
  return -1.7 + 0.12 * std::max(0.0, x - 15);
}
double camber(double x, double y) {
  return -1.7 + 0.05 * x - 0.08 * y;
}

// Of how many points the side differs between a cloud and the same one turned.
std::size_t moved(const Cloud<float>& upright, const Eigen::Matrix3d& rotation) {
  const GroundSplit expected = split(scene_view(upright));
  const Cloud<float> cloud = turned(upright, rotation);
  GroundZonesOptions settings;
  settings.up = 0.3 * rotation.col(2);
  const GroundSplit result = split(scene_view(cloud), settings);
  EXPECT_LT((result.normal - rotation * expected.normal).norm(), 1e-3);
  settings.up *= 0x1p-500;
  const GroundSplit same = split(scene_view(cloud), settings);
  EXPECT_TRUE(same.ground == result.ground && same.normal == result.normal && same.offset == result.offset);
  std::vector<std::int32_t> others;
  std::set_symmetric_difference(result.ground.begin(), result.ground.end(), expected.ground.begin(),
                                expected.ground.end(), std::back_inserter(others));
  return others.size();
}

TEST(GroundZones, OfATurnedCloudAreNearlyTheSame) {
  for (const Height height : {hill, camber}) {
    Cloud<float> upright = ground_of(height);
    const std::size_t ground = upright.size();
    add_boxes(upright, height);
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE(seed);
      const Eigen::Matrix3d any = any_rotation(seed);
      // The sectors begin elsewhere about up, so patches hold other points.
      EXPECT_LE(moved(upright, any), ground / 100);
      // They turn with up if that leaves the nearest axis the shortest way: only floats round otherwise.
      const Eigen::Vector3d tilted = Eigen::Vector3d::UnitZ() + 0.5 * any.col(2);
      const auto shortest = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), tilted);
      EXPECT_EQ(moved(upright, shortest.toRotationMatrix()), 0U);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
