// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres, for which the device rejects blocks near a centre.

#include <algorithm>
#include <random>

#include "clouds.h"
#include "gpu_test.h"
#include "pcl_bv/gpu/cluster_supports.h"
#include "pcl_bv/kernels/distances.h"

namespace pcl_bv {
namespace {

using test::small_buffers;
using test::TestCloud;

// Clouds in the order of a sweep, so that few blocks are far from the middle.
TestCloud<float> sweep(std::size_t points, std::uint64_t seed, float scale, float offset) {
  std::mt19937_64 random(seed);
  std::normal_distribution<float> normal;
  TestCloud<float> cloud{"sweep seed=" + std::to_string(seed), {}};
  for (std::size_t i = 0; i < points; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(points);
    const float range = scale * (1 + 0.5F * std::sin(7 * angle) + 0.02F * normal(random));
    cloud.xyz.insert(cloud.xyz.end(), {offset + range * std::cos(angle), offset + range * std::sin(angle),
                                       offset + 0.1F * scale * normal(random)});
  }
  return cloud;
}

TEST(FarBlocks, HaveEachPointThatIsAsFarAsTheLimit) {
  PCL_BV_NEEDS_DEVICE();
  std::mt19937_64 random(3);
  for (const auto& [scale, offset] :
       std::vector<std::pair<float, float>>{{1, 0}, {30, 5e5F}, {1e-9F, 1e-10F}, {1e15F, 3}}) {
    const TestCloud<float> points = sweep(100'000, 5, scale, offset);
    const GpuCloud cloud(small_buffers(), points.view());
    const auto far_blocks = detail::far_blocks_on_device(cloud.on_device());
    for (int trial = 0; trial < 60; ++trial) {
      SCOPED_TRACE(testing::Message() << "scale " << scale << ", offset " << offset << ", trial " << trial);
      const std::size_t farthest = random() % points.size();
      const Coordinates p = load_point(points.view(), farthest),
                        near = load_point(points.view(), random() % points.size());
      const detail::DistanceCenter center{offset + 0.3 * (near.x - offset), offset + 0.3 * (near.y - offset),
                                          offset + 0.1 * (near.z - offset), 1};
      const double limit = detail::squared_distance(p, center);
      std::vector<std::uint32_t> blocks;
      if (!far_blocks->find(center, limit, blocks)) continue;
      EXPECT_TRUE(std::is_sorted(blocks.begin(), blocks.end()));
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (detail::squared_distance(load_point(points.view(), i), center) < limit) continue;
        ASSERT_TRUE(std::binary_search(blocks.begin(), blocks.end(), i / kBlockPoints)) << "point " << i;
      }
    }
  }
}

TEST(FarBlocks, HaveAPointAtTheLimitThatIsAloneInItsBlock) {
  PCL_BV_NEEDS_DEVICE();
  std::mt19937_64 random(12);
  std::normal_distribution<float> normal;
  for (const float offset : {0.0F, 7.0F, 123456.0F}) {
    SCOPED_TRACE(testing::Message() << "offset " << offset);
    constexpr std::size_t blocks = 200;
    TestCloud<float> points{"one far point in each block", std::vector<float>(3 * 1024 * blocks, offset)};
    for (std::size_t b = 0; b < blocks; ++b) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        points.xyz[3 * (1024 * b + b) + axis] += normal(random);
    }
    const GpuCloud cloud(small_buffers(), points.view());
    const auto far_blocks = detail::far_blocks_on_device(cloud.on_device());
    const detail::DistanceCenter center{offset + 0.1 / 3, offset - 0.1 / 7, offset + 0.01 / 9, 1};
    for (std::uint32_t b = 0; b < blocks; ++b) {
      std::vector<std::uint32_t> found;
      const double limit = detail::squared_distance(load_point(points.view(), 1024 * b + b), center);
      ASSERT_TRUE(far_blocks->find(center, limit, found));
      ASSERT_TRUE(std::binary_search(found.begin(), found.end(), b)) << "block " << b;
    }
  }
}

TEST(FarBlocks, AreFewOfALargeCloud) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = sweep(200'000, 6, 30, 1000);
  const GpuCloud cloud(small_buffers(), points.view());
  std::vector<std::uint32_t> blocks;
  const auto far_blocks = detail::far_blocks_on_device(cloud.on_device());
  EXPECT_TRUE(far_blocks->find({1000, 1000, 1000, 1}, 44.0 * 44, blocks));
  EXPECT_GT(blocks.size(), 5U);
  EXPECT_LT(blocks.size(), 100U);
  EXPECT_FALSE(far_blocks->find({1000, 1000, 1000, 1}, 0, blocks));     // nothing can be rejected
  EXPECT_FALSE(far_blocks->find({1000, 1000, 1000, 1}, 1e40, blocks));  // floats overflow
}

TEST(FarBlocks, GiveTheBitsOfTheProcessorForEveryGrowth) {
  PCL_BV_NEEDS_DEVICE();
  const std::vector<const Method*> methods = test::methods_named(
      {"sphere-ritter", "sphere-epos6", "sphere-epos14", "sphere-epos26", "sphere-epos98", "sphere-exact"});
  std::vector<TestCloud<float>> clouds = {sweep(150'000, 8, 30, 5e5F), sweep(99'999, 9, 1e-6F, 0),
                                          test::gaussian<float>(120'000, 10, 3),
                                          sweep(70'000, 11, 1e17F, 1e18F)};
  for (std::size_t i = 0; i < 3000; ++i)
    clouds[0].xyz[3 * (i * 37) + i % 3] = std::numeric_limits<float>::quiet_NaN();
  for (const TestCloud<float>& points : clouds) {
    for (const SphereGrowth growth :
         {SphereGrowth::sequential, SphereGrowth::stationary, SphereGrowth::deferred}) {
      SCOPED_TRACE(points.name + ", growth " + std::to_string(static_cast<int>(growth)));
      MethodOptions options;
      options.growth = growth;
      const std::vector<Fitted<AnyVolume>> expected = fit_methods(points.view(), methods, options);
      for (const HostPoints host : {HostPoints::keep, HostPoints::release}) {
        const GpuCloud cloud(small_buffers(), points.view(), host);
        test::expect_same(fit(cloud, methods, options), expected, methods);
        test::expect_same(fit(cloud, methods, options, {Threads{3}}), expected, methods);
      }
    }
  }
}

}  // namespace
}  // namespace pcl_bv
