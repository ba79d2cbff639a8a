// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A mask of so many regions that it does not test all points against all is the loop over them, too.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <thread>

#include "allocations.h"
#include "any_volumes.h"
#include "clouds.h"
#include "executions.h"
#include "inflated.h"
#include "pcl_bv/points/point_groups.h"
#include "pcl_bv/points/point_source.h"
#include "pcl_bv/trees/region_mask.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;
using Marks = std::vector<std::uint8_t>;

// As many as `count`, of ten kinds, each some `size` large, of which a cloud of gaussian() holds parts.
std::vector<Region> many_regions(Random& random, std::size_t count, double size, double spread) {
  std::vector<Region> regions;
  const Scale scale{"", 0, size};
  while (regions.size() < count) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      Eigen::Isometry3d apart = Eigen::Isometry3d::Identity();
      apart.translation() = random.vector(spread);
      regions.push_back({transformed(volume, apart), 0.1 * size * static_cast<double>(regions.size() % 3)});
    }
  }
  regions.resize(count);
  return regions;
}

// Along a path, as a sensor sees them, so that neighbours in the row are neighbours in space; some points do
// not count.
test::TestCloud<float> scanned(std::size_t count, unsigned seed) {
  test::TestCloud<float> cloud = test::gaussian<float>(count, seed, 0.02);
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = static_cast<double>(i) / 2000;
    cloud.xyz[3 * i] += static_cast<float>(1.5 * std::cos(turn));
    cloud.xyz[3 * i + 1] += static_cast<float>(1.5 * std::sin(turn));
    cloud.xyz[3 * i + 2] += static_cast<float>(std::sin(0.01 * turn));
  }
  for (const std::size_t i : {5, 1000, 2001, 2500})  // of each axis
    cloud.xyz[i] = std::numeric_limits<float>::quiet_NaN();
  cloud.xyz[3001] = std::numeric_limits<float>::infinity();
  return cloud;
}

TEST(RegionMask, OfAnyNumberOfRegionsIsTheLoopOverThem) {
  Random random(31);
  for (const std::size_t count : {std::size_t{1}, RegionMask::kFewRegions, RegionMask::kFewRegions + 1,
                                  std::size_t{60}, std::size_t{300}, std::size_t{2000}}) {
    for (const double size : {0.05, 0.7}) {
      const std::vector<Region> regions = many_regions(random, count, size, 1.5);
      const RegionMask mask(regions);
      const std::size_t points = count > 1000 ? 4000 : 20'000;
      for (const auto& cloud : {scanned(points, 31), test::gaussian<float>(points, 32)}) {
        std::vector<AnyVolume> volumes;
        for (const auto& [volume, padding] : regions)
          volumes.push_back(inflated(volume, padding));
        Marks expected;
        for (std::size_t i = 0; i < points; ++i) {
          const Coordinates p = load_point(cloud.view(), i);
          expected.push_back(is_valid(p) &&
                             std::any_of(volumes.begin(), volumes.end(), [&](const AnyVolume& volume) {
                               return contains(volume, Vector3d(p.x, p.y, p.z));
                             }));
        }
        Marks inside;
        mask.mark(cloud.view(), inside);
        ASSERT_EQ(inside, expected) << count << ", " << size;
        for (std::size_t i = 0; i < points; i += 97) {
          const Coordinates p = load_point(cloud.view(), i);
          ASSERT_EQ(mask.contains({p.x, p.y, p.z}), expected[i] == 1) << count << ", " << size;
        }
      }
    }
  }
}

// Few, whose tests are those above, in groups.
Marks by_groups(const std::vector<Region>& regions, const PointView& points) {
  Marks all(points.count, 0), some;
  for (std::size_t i = 0; i < regions.size(); i += RegionMask::kFewRegions) {
    const auto begin = regions.begin() + static_cast<std::ptrdiff_t>(i);
    const std::size_t count = std::min(RegionMask::kFewRegions, regions.size() - i);
    RegionMask({begin, begin + static_cast<std::ptrdiff_t>(count)}).mark(points, some);
    for (std::size_t k = 0; k < points.count; ++k)
      all[k] |= some[k];
  }
  return all;
}

template <typename T>
void expect_many_for_every_execution() {
  Random random(33);
  std::vector<Region> regions = many_regions(random, 400, 0.2, 2);
  SlabVector min = SlabVector::Constant(7, -0.3), max = SlabVector::Constant(7, 0.3);
  min[3] = 5, max[3] = 6;
  regions.push_back({Kdop(KdopSet::dop14(), min, max), 0});
  regions.push_back({Hull({{0, 0, 0}}, {}, {{Vector3d(0, 0, -1), -1.4}}, 0), 0});  // a half space
  const RegionMask mask(regions);
  const auto floats = scanned(2 * kChunkPoints + 77, 33);
  test::TestCloud<T> cloud;
  for (const float x : floats.xyz)
    cloud.xyz.push_back(static_cast<T>(x));
  std::vector<std::int32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  PointView shuffled = cloud.view();
  shuffled.indices = order.data();
  const test::CopyingSource<T> source(cloud);
  const PointGroups groups(cloud.view());
  const Marks expected = by_groups(regions, cloud.view());
  EXPECT_GT(std::accumulate(expected.begin(), expected.end(), 0), 3000);
  for (const auto& [name, execution] : test::every_execution()) {
    Marks inside;
    for (const PointView& view : {cloud.view(), source.view(), groups.view()}) {
      mask.mark(view, inside, execution);
      ASSERT_EQ(inside, expected) << name;
    }
    mask.mark(shuffled, inside, execution);
    for (std::size_t i = 0; i < order.size(); ++i)
      ASSERT_EQ(inside[i], expected[static_cast<std::size_t>(order[i])]) << name << ", " << i;
  }
}

TEST(RegionMask, OfManyRegionsIsTheSameForEveryExecutionAndOrderOfFloats) {
  expect_many_for_every_execution<float>();
}
TEST(RegionMask, OfManyRegionsIsTheSameForEveryExecutionAndOrderOfDoubles) {
  expect_many_for_every_execution<double>();
}

// The runs' boxes reach regions, but each point lacks a coordinate, or all but one.
TEST(RegionMask, OfManyRegionsHoldsNoPointThatLacksACoordinate) {
  Random random(34);
  const std::vector<Region> regions = many_regions(random, 1000, 0.7, 0.2);
  const RegionMask mask(regions);
  test::TestCloud<double> cloud;
  cloud.xyz.assign(3 * 500, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.xyz[3 * i + i % 3] = kNan;
  Marks inside;
  mask.mark(cloud.view(), inside);
  EXPECT_EQ(std::accumulate(inside.begin(), inside.end(), 0), 0);
  cloud.xyz[3 * 77 + 77 % 3] = 0;
  EXPECT_TRUE(mask.contains({0, 0, 0}));
  mask.mark(cloud.view(), inside);
  EXPECT_EQ(std::accumulate(inside.begin(), inside.end(), 0), 1);
  EXPECT_EQ(inside[77], 1);
}

// A tree of regions needs lists of those that runs reach, which each thread allocates once.
TEST(RegionMask, OfFewRegionsAllocatesNothingInAnyThread) {
  const auto cloud = test::gaussian<float>(1000, 35);
  for (const std::size_t count : {std::size_t{1}, RegionMask::kFewRegions}) {
    const RegionMask mask(std::vector<Region>(count, {Sphere({0, 0, 0}, 1)}));
    Marks inside;
    mask.mark(cloud.view(), inside, {Serial{}});
    std::size_t before = 0, after = 0;
    std::thread([&] {
      before = allocations();
      mask.mark(cloud.view(), inside, {Serial{}});
      after = allocations();
    }).join();
    EXPECT_EQ(after, before) << count;
  }
  EXPECT_EQ((Region{Sphere({0, 0, 0}, 1)}).padding, 0);
}

}  // namespace
}  // namespace pcl_bv::detail
