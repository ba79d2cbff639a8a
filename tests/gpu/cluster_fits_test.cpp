// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Fits to many clusters at a time.

#include <algorithm>
#include <numeric>
#include <random>

#include "clouds.h"
#include "cluster_pass.h"
#include "executions.h"
#include "gpu_test.h"

namespace pcl_bv {
namespace {

using test::expect_same;
using test::small_buffers;
using test::TestCloud;

const std::vector<const Method*>& slab_methods() {
  static const std::vector<const Method*> methods =
      test::methods_named({"aabb", "dop6", "dop14", "dop18", "dop26"});
  return methods;
}

std::vector<Fitted<AnyVolume>> fits_of(const ClusterFits& fits, std::size_t cluster, std::size_t methods) {
  std::vector<Fitted<AnyVolume>> all;
  for (std::size_t m = 0; m < methods; ++m)
    all.push_back(fits.fitted(cluster, m));
  return all;
}

void expect_same_clusters(const GpuCloud& cloud, const PointView& points,
                          const std::vector<std::size_t>& offsets,
                          const std::vector<const Method*>& methods) {
  const ClusterFits fits = fit(cloud, offsets, methods);
  ASSERT_EQ(fits.size(), offsets.size() - 1);
  for (std::size_t c = 0; c < fits.size(); ++c) {
    SCOPED_TRACE(testing::Message() << "cluster " << c << " of " << offsets[c + 1] - offsets[c] << " points");
    const PointView cluster = points.slice(offsets[c], offsets[c + 1] - offsets[c]);
    expect_same(fits_of(fits, c, methods.size()), fit_methods(cluster, methods), methods);
    if (testing::Test::HasFailure()) return;
  }
}

// All nasty clouds one after another, each a cluster.
TestCloud<float> nasty_clusters(std::vector<std::size_t>& offsets) {
  TestCloud<float> all{"nasty clusters", {}};
  offsets = {0};
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    all.xyz.insert(all.xyz.end(), cloud.xyz.begin(), cloud.xyz.end());
    offsets.push_back(all.size());
  }
  return all;
}

std::size_t count_found(const GpuCloud& cloud, const std::vector<std::size_t>& offsets,
                        detail::DirectionSet set) {
  const detail::DeviceClusters clusters{{offsets.begin(), offsets.end()}, nullptr};
  const std::vector<std::uint8_t> found = detail::find_slabs(cloud.on_device(), clusters, set, {}).found;
  return static_cast<std::size_t>(std::count(found.begin(), found.end(), 1));
}

TEST(ClusterFits, HaveTheBitsOfTheProcessorOnNastyClusters) {
  PCL_BV_NEEDS_DEVICE();
  std::vector<std::size_t> offsets;
  const TestCloud<float> all = nasty_clusters(offsets);
  for (const HostPoints host : {HostPoints::keep, HostPoints::release}) {
    const GpuCloud cloud(small_buffers(), all.view(), host);
    expect_same_clusters(cloud, all.view(), offsets, slab_methods());
    for (const Method* method : slab_methods())
      expect_same_clusters(cloud, all.view(), offsets, {method});
  }
}

TEST(ClusterFits, HaveTheBitsOfTheProcessorForOtherMethods) {
  PCL_BV_NEEDS_DEVICE();
  std::vector<std::size_t> offsets;
  const TestCloud<float> all = nasty_clusters(offsets);
  const std::vector<const Method*> methods =
      test::methods_named({"sphere-epos26", "aabb", "obb-pca", "sphere-ritter"});
  expect_same_clusters(GpuCloud(small_buffers(), all.view(), HostPoints::release), all.view(), offsets,
                       methods);
  expect_same_clusters(GpuCloud(small_buffers(), all.view()), all.view(), offsets,
                       test::methods_named({"sphere-exact"}));
}

TEST(ClusterFits, HaveTheBitsOfTheProcessorForDoubles) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<double> points = test::gaussian<double>(3000, 5, 3, 5e6);
  expect_same_clusters(GpuCloud(small_buffers(), points.view()), points.view(), {0, 1000, 1000, 3000},
                       slab_methods());
}

// Clusters of all shapes in which hardly anything decides but the last bits.
TEST(ClusterFits, HaveTheBitsOfTheProcessorOnRandomClusters) {
  PCL_BV_NEEDS_DEVICE();
  const std::size_t clusters = test::kFewCases ? 2000 : 40'000;
  std::mt19937_64 random(2026);
  std::normal_distribution<float> normal;
  TestCloud<float> all{"random clusters", {}};
  std::vector<std::size_t> offsets{0};
  for (std::size_t c = 0; c < clusters; ++c) {
    const std::size_t points = random() % (c % 50 == 0 ? 300 : 30);
    const float offset[3] = {normal(random) * 100, normal(random) * 100,
                             std::ldexp(1.0F, static_cast<int>(c % 40) - 20)};
    const float scale = std::ldexp(1.0F, static_cast<int>(random() % 30) - 20);
    const bool coarse = random() % 4 == 0, flat = random() % 10 == 0;
    for (std::size_t i = 0; i < 3 * points; ++i) {
      const float deviation = flat && i % 3 == 2 ? 0.0F : normal(random) * scale;
      all.xyz.push_back(offset[i % 3] + (coarse ? std::round(deviation / scale) * scale : deviation));
    }
    offsets.push_back(all.size());
  }
  const GpuCloud cloud(small_buffers(), all.view());
  const ClusterFits fits = fit(cloud, offsets, slab_methods());
  for (std::size_t c = 0; c < clusters; ++c) {
    SCOPED_TRACE(testing::Message() << "cluster " << c << ", seed 2026");
    const PointView cluster = all.view().slice(offsets[c], offsets[c + 1] - offsets[c]);
    expect_same(fits_of(fits, c, 5), fit_methods(cluster, slab_methods()), slab_methods());
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(count_found(cloud, offsets, detail::DirectionSet::dop26), clusters / 2);
}

// Extreme points whose sums have up to 63 bits and must be rounded, or more than the device can hold.
TEST(ClusterFits, HaveTheBitsOfTheProcessorWhereSumsNeedMoreBitsThanADouble) {
  PCL_BV_NEEDS_DEVICE();
  std::mt19937_64 random(11);
  std::normal_distribution<float> normal;
  TestCloud<float> all{"many bits", {}};
  std::vector<std::size_t> offsets{0};
  for (int c = 0; c < 3000; ++c) {
    const int tiny = 5 - c % 30;
    for (int i = 0; i < 40; ++i) {
      for (int axis = 0; axis < 3; ++axis)
        all.xyz.push_back(std::ldexp(normal(random), i < 12 ? tiny : 20));
      if (i < 12)
        all.xyz[all.xyz.size() - 3 + i % 3] =
            std::ldexp(normal(random) < 0 ? -8.0F : 8.0F, 20) * (1 + 0.01F * static_cast<float>(i));
    }
    offsets.push_back(all.size());
  }
  const GpuCloud cloud(small_buffers(), all.view());
  expect_same_clusters(cloud, all.view(), offsets, slab_methods());
  const std::size_t found = count_found(cloud, offsets, detail::DirectionSet::dop26);
  EXPECT_GT(found, 500U);
  EXPECT_LT(found, 2500U);
}

TEST(ClusterFits, TakeListsOfIndicesInAnyOrder) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = test::gaussian<float>(20'000, 6, 5, 100);
  std::mt19937_64 random(4);
  IndexLists lists;
  for (int list = 0; list < 300; ++list) {
    for (std::size_t i = random() % 200; i > 0; --i)
      lists.indices.push_back(static_cast<std::int32_t>(random() % points.size()));
    lists.offsets.push_back(lists.indices.size());
  }
  const PointView part = points.view().slice(5000, 15'000);
  for (const HostPoints host : {HostPoints::keep, HostPoints::release}) {
    const GpuCloud cloud(small_buffers(), points.view(), host);
    const ClusterFits fits = fit(cloud, lists, slab_methods());
    for (std::size_t c = 0; c < lists.size(); ++c)
      expect_same(fits_of(fits, c, 5),
                  fit_methods(points.view().subset(lists.list(c), lists.list_size(c)), slab_methods()),
                  slab_methods());
  }
  // The indices of a slice are those in the whole cloud.
  EXPECT_THROW(fit(GpuCloud(small_buffers(), part), lists, slab_methods()), std::out_of_range);
  for (std::int32_t& index : lists.indices)
    index = index % 15'000 + 5000;
  const ClusterFits fits = fit(GpuCloud(small_buffers(), part), lists, slab_methods());
  for (std::size_t c = 0; c < lists.size(); ++c)
    expect_same(fits_of(fits, c, 5),
                fit_methods(points.view().subset(lists.list(c), lists.list_size(c)), slab_methods()),
                slab_methods());
}

TEST(ClusterFits, HaveTheBitsOfTheProcessorAcrossBuffers) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = test::gaussian<float>(250'000, 7, 20, -400);
  std::vector<std::size_t> offsets{0};
  std::mt19937_64 random(8);
  while (offsets.back() < points.size())
    offsets.push_back(std::min(points.size(), offsets.back() + random() % 20'000));
  offsets.insert(offsets.end(), {points.size(), points.size()});
  const GpuCloud cloud(small_buffers(), points.view());
  EXPECT_GT(cloud.on_device().parts().size(), 2U);
  expect_same_clusters(cloud, points.view(), offsets, slab_methods());
  EXPECT_GT(count_found(cloud, offsets, detail::DirectionSet::dop14), offsets.size() - 8);
  expect_same_clusters(cloud, points.view(), {5, 100'000, 100'000, 100'200, 250'000}, slab_methods());
}

TEST(ClusterFits, OfEmptyCloudsAndWithoutClustersAreEmpty) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = test::gaussian<float>(10, 7);
  const GpuCloud cloud(small_buffers(), points.view()),
      empty(small_buffers(), PointView(), HostPoints::release);
  EXPECT_EQ(fit(cloud, std::vector<std::size_t>{3}, slab_methods()).size(), 0U);
  EXPECT_EQ(fit(empty, std::vector<std::size_t>{0}, slab_methods()).size(), 0U);
  const ClusterFits fits = fit(empty, IndexLists{{}, {0, 0, 0}}, slab_methods());
  ASSERT_EQ(fits.size(), 2U);
  EXPECT_EQ(fits.result(1).status, EstimationStatus::no_valid_points);
  EXPECT_TRUE(pcl_bv::empty(fits.fitted(1, 4).volume));
  EXPECT_THROW(fits.fitted(2, 0), std::out_of_range);
  EXPECT_THROW(fits.fitted(0, 5), std::out_of_range);
}

TEST(ClusterFits, RefuseWhatIsOutsideTheCloud) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> points = test::gaussian<float>(10, 7);
  const GpuCloud cloud(small_buffers(), points.view());
  const auto of = [&](const std::vector<std::size_t>& offsets) { fit(cloud, offsets, slab_methods()); };
  EXPECT_THROW(of({}), std::invalid_argument);
  EXPECT_THROW(of({0, 5, 4}), std::invalid_argument);
  EXPECT_THROW(of({0, 11}), std::out_of_range);
  EXPECT_THROW(fit(cloud, IndexLists{{0, 10}, {0, 2}}, slab_methods()), std::out_of_range);
  EXPECT_THROW(fit(cloud, IndexLists{{-1}, {0, 1}}, slab_methods()), std::out_of_range);
  EXPECT_THROW(fit(cloud, std::vector<std::size_t>{0, 10}, {nullptr}), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv
