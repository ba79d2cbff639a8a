// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The mask is the same however it is run; where it ends, and what it refuses.

#include "pcl_bv/trees/region_mask.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "allocations.h"
#include "clouds.h"
#include "executions.h"
#include "flush_to_zero.h"
#include "pcl_bv/points/point_groups.h"
#include "region_marks.h"
#include "sources.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

// Corners of the inflated volumes may be far beyond aabb() plus the padding.
TEST(RegionMask, ExtentsHoldAllPointsInside) {
  Random random(7);
  const auto is_in = [](const std::vector<Aabb>& boxes, const Vector3d& point) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const Aabb& box) { return box.contains(point); });
  };
  for (const Scale& scale : {scales()[0], scales()[1], scales()[5]}) {
    std::size_t in = 0, beyond = 0;
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      const double padding = 0.5 * scale.extent;
      const RegionMask mask({{volume, padding}});
      const std::vector<Aabb> extents = mask.extents();
      ASSERT_EQ(extents.size(), 1U);
      const Vector3d grown = Vector3d::Constant(padding * (1 + 1e-6));
      const Aabb box = aabb(volume), simple(box.min() - grown, box.max() + grown);
      for (int i = 0; i < 3000; ++i) {
        const Vector3d point =
            box.center() + (0.5 * (box.max() - box.min()) + 2 * grown).cwiseProduct(random.vector(1));
        if (!mask.contains(point)) continue;
        ++in;
        beyond += simple.contains(point) ? 0 : 1;
        ASSERT_TRUE(is_in(extents, point)) << shape_name(volume) << ", " << scale.name;
      }
    }
    EXPECT_GT(in, 1000U) << scale.name;
    EXPECT_GT(beyond, 10U) << scale.name;
  }
  EXPECT_TRUE(RegionMask({}).extents().empty());
  EXPECT_TRUE(RegionMask({{Aabb(), 1}}).extents().empty());
}

TEST(RegionMask, IsTheSameOnEveryInstructionSetAndAnyNumberOfThreads) {
  Random random(4);
  const std::vector<Region> regions = ten_and_more(random, scales().front());
  const RegionMask mask(regions);
  const auto cloud = test::gaussian<float>(test::kEmulated ? 140'000 : 330'001, 4);
  const Marks expected = marks(mask, cloud.view(), {Serial{}, Isa::scalar});
  EXPECT_GT(std::accumulate(expected.begin(), expected.end(), 0), 10'000);
  for (const auto& [name, execution] : test::every_execution())
    EXPECT_EQ(marks(mask, cloud.view(), execution), expected) << name;
}

TEST(RegionMask, FollowsEveryLayoutAndOrderOnEveryInstructionSet) {
  Random random(5);
  const RegionMask mask(ten_and_more(random, scales().front()));
  const auto cloud = test::gaussian<float>(2 * kChunkPoints + 77, 5);
  const Marks expected = marks(mask, cloud.view(), {Serial{}, Isa::scalar});
  std::vector<std::int32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  PointView shuffled = cloud.view();
  shuffled.indices = order.data();
  const test::Records<float> padded(cloud, 16), wide(cloud, 32, 4), odd(cloud, 13);
  const test::CopyingSource<float> source(cloud);
  const PointGroups groups(cloud.view());
  for (const Isa isa : usable_isas()) {
    const Execution execution{Threads{2}, isa};
    for (const PointView& view : {padded.view(), wide.view(), odd.view(), source.view(), groups.view()})
      EXPECT_EQ(marks(mask, view, execution), expected) << isa_name(isa);
    const Marks permuted = marks(mask, shuffled, execution);
    for (std::size_t i = 0; i < order.size(); ++i)
      ASSERT_EQ(permuted[i], expected[static_cast<std::size_t>(order[i])]) << isa_name(isa) << ", " << i;
  }
}

TEST(RegionMask, MovesWithThePointsByPowersOfTwo) {
  Random random(6);
  const auto rounded = [&](double extent) -> Vector3d {
    return (random.vector(extent) * 1024).array().round() / 1024;
  };
  for (const double step : {0x1p10, -0x1p20}) {
    const Vector3d by(step, -step, 2 * step);
    std::vector<Region> here, there;
    for (int i = 0; i < 5; ++i) {
      const Vector3d c = rounded(1), d = rounded(1), n = random.vector(1);
      const Eigen::Matrix3d axes = random.isometry(1).linear();
      const Vector3d low = c.cwiseMin(d), high = c.cwiseMax(d), size(0.3, 0.2, 0.1);
      for (auto* regions : {&here, &there}) {
        const Vector3d at = regions == &here ? Vector3d::Zero() : by;
        regions->insert(regions->end(), {{Aabb(low + at, high + at), 0.125},
                                         {Sphere(c + at, 0.3), 0.1},
                                         {Obb(c + at, axes, size), 0.1},
                                         {Cylinder(c + at, n, 0.3, 0.2), 0.1},
                                         {Capsule(c + at, d + at, 0.1), 0.1},
                                         {Ellipsoid(c + at, axes, size), 0.1}});
      }
    }
    std::vector<Vector3d> points, moved;
    for (int i = 0; i < 3000; ++i) {
      points.push_back(rounded(2));
      moved.push_back(points.back() + by);
    }
    EXPECT_EQ(marks(RegionMask(there), cloud_of<double>(moved).view()),
              marks(RegionMask(here), cloud_of<double>(points).view()));
  }
}

TEST(RegionMask, HoldsNoPointThatDoesNotCount) {
  const RegionMask everywhere({{Aabb(Vector3d::Constant(-1e300), Vector3d::Constant(1e300)), 0},
                               {Sphere({0, 0, 0}, 1e100), 1e100},
                               {cube({-1e99, -1e99, -1e99}, 2e99), 1e100}});
  for (const double bad : {kNan, kInfinity, -kInfinity, 1.1e100, -1e200}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d point(1, 2, 3);
      point[axis] = bad;
      EXPECT_FALSE(everywhere.contains(point)) << bad;
      EXPECT_EQ(marks(everywhere, cloud_of<double>({point, {1, 2, 3}}).view()), (Marks{0, 1})) << bad;
      if (std::abs(bad) < kInfinity) continue;
      EXPECT_EQ(marks(everywhere, cloud_of<float>({point, {1, 2, 3}}).view()), (Marks{0, 1})) << bad;
    }
  }
}

TEST(RegionMask, OfNoRegionsOrEmptyOnesMarksNothing) {
  const auto cloud = test::gaussian<float>(1000, 7);
  const std::vector<Region> empty = {{Aabb(), 1},     {Kdop(), 1},    {Sphere(), 1},    {Obb(), 1},
                                     {Cylinder(), 1}, {Capsule(), 1}, {Ellipsoid(), 1}, {Hull(), 1}};
  for (const RegionMask& mask : {RegionMask({}), RegionMask(empty)}) {
    EXPECT_EQ(marks(mask, cloud.view()), Marks(1000, 0));
    EXPECT_EQ(marks(mask, PointView()), Marks());
    EXPECT_FALSE(mask.contains({0, 0, 0}));
  }
}

TEST(RegionMask, RefusesAPaddingThatIsNoneAndSaysSo) {
  for (const double bad : {-1e-300, -1.0, kNan, kInfinity, 1.1e100}) {
    EXPECT_THROW(RegionMask({{Sphere({0, 0, 0}, 1), 0.5}, {Sphere(), bad}}), std::invalid_argument) << bad;
  }
  try {
    RegionMask({{Sphere({0, 0, 0}, 1), -0.25}});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("from 0 to 1e100, not -0.25"));
  }
}

TEST(RegionMask, IsTheSameOnAHostThatFlushesToZero) {
  Random random(9);
  const Scale tiny{"1e-41", 0, 1e-41};
  const std::vector<Region> regions = ten_and_more(random, tiny);
  const auto cloud = test::gaussian<float>(3000, 9, 1e-41);
  const Marks expected = marks(RegionMask(regions), cloud.view());
  EXPECT_GT(std::accumulate(expected.begin(), expected.end(), 0), 100);
  const test::FlushToZero flushing;
  EXPECT_EQ(marks(RegionMask(regions), cloud.view()), expected);
}

TEST(RegionMask, AllocatesNothingInASecondPass) {
  Random random(10);
  const RegionMask mask(ten_and_more(random, scales().front()));
  const auto cloud = test::gaussian<float>(3 * kChunkPoints, 10);
  Marks inside;
  mask.mark(cloud.view(), inside);
  const std::size_t before = allocations();
  mask.mark(cloud.view(), inside);
  EXPECT_EQ(allocations(), before);
}

TEST(RegionMask, ACapsuleOfEqualEndsIsABall) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-2, 2);
  std::vector<float> xyz(30'000);
  for (float& coordinate : xyz)
    coordinate = uniform(random);
  const PointView points = PointView::of(xyz.data(), 12, xyz.size() / 3);
  const Eigen::Vector3d center(0.25, -0.5, 0.125);
  std::vector<std::uint8_t> capsule, ball;
  RegionMask({{Capsule(center, center, 0.75), 0.5}}).mark(points, capsule);
  RegionMask({{Sphere(center, 0.75), 0.5}}).mark(points, ball);
  EXPECT_GT(std::count(ball.begin(), ball.end(), 1), 500);
  EXPECT_EQ(capsule, ball);
}

}  // namespace
}  // namespace pcl_bv::detail
