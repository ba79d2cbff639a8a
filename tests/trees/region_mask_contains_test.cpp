// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The mask of every set is contains() of the grown volumes, point by point.

#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "few_cases.h"
#include "region_marks.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

// Returns what contains() says of each point.
Marks expect_marks(const std::vector<Region>& regions, const PointView& points, const std::string& name) {
  const RegionMask mask(regions);
  const Marks expected = contained(regions, points);
  for (const Isa isa : usable_isas())
    EXPECT_EQ(marks(mask, points, {Serial{}, isa}), expected) << name << ", " << isa_name(isa);
  return expected;
}

template <typename T>
void expect_contains() {
  Random random(1);
  for (const Scale& scale : scales()) {
    std::size_t in = 0, all = 0;
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      for (const double part : {0.0, 1e-3, 0.5}) {
        const double padding = part * scale.extent;
        const auto cloud = cloud_of<T>(points_about(random, volume, padding, test::kFewCases ? 5 : 40));
        const Marks expected =
            expect_marks({{volume, padding}}, cloud.view(),
                         std::string(shape_name(volume)) + ", " + scale.name + ", " + std::to_string(part));
        if (::testing::Test::HasFailure()) return;
        in += static_cast<std::size_t>(std::accumulate(expected.begin(), expected.end(), 0));
        all += expected.size();
      }
    }
    // Those of 1e99 are no floats, and those of 1e-100 are at 0.
    if (sizeof(T) == 8 || (scale.extent > 1e-50 && scale.extent < 1e50)) {
      EXPECT_GT(in, all / 10) << scale.name;
      EXPECT_LT(in, all) << scale.name;
    }
  }
}

TEST(RegionMask, OfFloatsIsContainsOfTheGrownVolume) {
  expect_contains<float>();
}

TEST(RegionMask, OfDoublesIsContainsOfTheGrownVolume) {
  expect_contains<double>();
}

TEST(RegionMask, OfManyRegionsIsTheirUnion) {
  Random random(2);
  for (const Scale& scale : {scales()[0], scales()[1], scales()[3], scales()[5]}) {
    const std::vector<Region> regions = ten_and_more(random, scale);
    std::vector<Vector3d> points;
    for (const auto& [volume, padding] : regions) {
      for (const Vector3d& p : points_about(random, volume, padding, 10))
        points.push_back(p);
    }
    const RegionMask mask(regions);
    const auto floats = cloud_of<float>(points);
    const auto doubles = cloud_of<double>(points);
    expect_marks(regions, floats.view(), scale.name);
    expect_marks(regions, doubles.view(), scale.name);
    for (std::size_t i = 0; i < points.size(); i += 7)
      ASSERT_EQ(mask.contains(points[i]), marks(mask, doubles.view().slice(i, 1))[0] == 1);
  }
}

TEST(RegionMask, OfNastyCloudsIsContainsOfTheVolumes) {
  Random random(3);
  std::vector<Region> regions = ten_and_more(random, scales().front());
  if (test::kFewCases) regions.erase(regions.begin() + 8, regions.end());
  regions.push_back({Aabb({-1e30, -1e30, 1e10}, {1e30, 2e38, 1e39}), 1});
  regions.push_back({Sphere({5e6, 5e6, 5e6}, 10), 0.5});
  for (const auto& cloud : test::nasty_clouds<float>())
    expect_marks(regions, cloud.view(), cloud.name);
  for (const auto& cloud : test::nasty_clouds<double>())
    expect_marks(regions, cloud.view(), cloud.name);
}

// A k-DOP whose slabs have no point in common is not empty(), and a plane may have any normal.
TEST(RegionMask, AsksContainsOfVolumesThatAreNone) {
  const auto set = KdopSet::dop14();
  SlabVector min = SlabVector::Constant(7, -1), max = SlabVector::Constant(7, 1);
  min[3] = 5, max[3] = 6;
  const Hull half({{0, 0, 0}}, {}, {{Vector3d(0.1, 0.2, 0.3), 0.5}}, 0);
  const Hull all({{0, 0, 0}}, {}, {{Vector3d::Zero(), 0}}, 0),
      none({{0, 0, 0}}, {}, {{Vector3d::Zero(), -1}}, 0);
  const auto cloud = test::gaussian<double>(2000, 8, 3);
  for (const AnyVolume& volume :
       {AnyVolume(Kdop(set, min, max)), AnyVolume(half), AnyVolume(all), AnyVolume(none)}) {
    for (const double padding : {0.0, 0.5, 2.0}) {
      const std::vector<Region> regions = {{volume, padding}};
      expect_marks(regions, cloud.view(), std::to_string(padding));
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
