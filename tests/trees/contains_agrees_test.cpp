// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Masks, trees of volumes and trees of points say of each point of a cloud what contains() of one point says:
// inside, for volumes that are fitted to the cloud.

#include <gtest/gtest.h>

#include <algorithm>

#include "clouds.h"
#include "executions.h"
#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"
#include "pcl_bv/trees/point_tree.h"
#include "pcl_bv/trees/region_mask.h"
#include "pcl_bv/trees/volume_tree.h"
#include "uneven_cloud.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

template <typename T>
void expect_agreement(int seed) {
  const test::TestCloud<T> cloud = test::uneven_cloud<T>(seed);
  const PointView points = cloud.view();
  for (const Method& method : methods()) {
    AnyVolume volume;
    if (test::take(method.fit(points), volume).used == 0) continue;
    const std::string name = std::string(method.name) + ", " + cloud.name;
    ASSERT_EQ(verify(volume, points).outside, 0u) << name;
    for (std::size_t i = 0; i < points.count; ++i)
      ASSERT_TRUE(contains(volume, vector(load_point(points, i)))) << name;
    const RegionMask mask({{volume, 0}});
    const VolumeTree tree({volume});
    std::vector<std::uint8_t> inside;
    std::vector<std::int32_t> found;
    for (const auto& [how, execution] : test::every_execution()) {
      mask.mark(points, inside, execution);
      EXPECT_EQ(std::count(inside.begin(), inside.end(), 1), 40) << name << ", mask, " << how;
      tree.first_containing(points, found, execution);
      EXPECT_EQ(std::count(found.begin(), found.end(), 0), 40) << name << ", tree of volumes, " << how;
    }
    EXPECT_EQ(PointTree(points).count_inside(volume), 40u) << name << ", tree of points";
  }
}

TEST(Contains, OfOneOfManyAndOfTreesAgreeOnCloudsWhoseAxesDifferByMagnitudesOnEveryInstructionSet) {
  for (int seed = 0; seed < 70; ++seed) {
    expect_agreement<double>(seed);
    expect_agreement<float>(seed);
  }
}

// What is within rounding of an axis is not along it.
TEST(Contains, OfManyMindsSmallComponentsOfANormalWhereCoordinatesAreGreat) {
  const Eigen::Vector3d nearly = {1, 1e-20, 0};
  const Hull hull(
      {{0, 0, 0}}, {},
      {{nearly, 0}, {-nearly, 10}, {{0, 1, 0}, 1e21}, {{0, -1, 0}, 1e21}, {{0, 0, 1}, 1}, {{0, 0, -1}, 1}},
      3);
  const double inside[] = {5, -1e21, 0};
  ASSERT_TRUE(hull.contains({5, -1e21, 0}));
  std::vector<std::uint8_t> marks;
  RegionMask({{hull, 0}}).mark(PointView::of(inside, sizeof(inside), 1), marks);
  EXPECT_EQ(marks.front(), 1);
  EXPECT_TRUE(VolumeTree({hull}).any_containing({5, -1e21, 0}));
}

}  // namespace
}  // namespace pcl_bv::detail
