// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.h"
#include "fits.h"
#include "pcl_bv/fitting/fit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>
#include <utility>

#include "executions.h"

namespace pcl_bv::detail {
namespace {

std::vector<PointView> views_of_sizes(const std::vector<std::size_t>& sizes) {
  std::vector<PointView> views(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i)
    views[i].count = sizes[i];  // only the sizes matter here
  return views;
}

TEST(Batch, FitsEachViewOnceOnEveryExecution) {
  const std::vector<PointView> views = views_of_sizes({300, 0, 500'000, 7, 100'000, 250'000, 40'000});
  for (const auto& [name, execution] : test::every_execution()) {
    SCOPED_TRACE(name);
    std::vector<std::atomic<int>> calls(views.size());
    for_each_view(
        views, [&](std::size_t i, const Execution&) { ++calls.at(i); }, execution);
    for (const auto& count : calls)
      EXPECT_EQ(count, 1);
  }
}

TEST(Batch, TakesTheLargestFirstAndEqualOnesInOrder) {
  std::vector<std::size_t> order;
  for_each_view(views_of_sizes({5, 300'000, 5, 90, 400'000}),
                [&](std::size_t i, const Execution&) { order.push_back(i); }, {Serial{}, Isa::scalar});
  EXPECT_EQ(order, (std::vector<std::size_t>{4, 1, 3, 0, 2}));
}

TEST(Batch, GivesBigCloudsTheWholePolicyAndOthersNone) {
  const std::vector<PointView> views = views_of_sizes({1'000'000, 1'000});
  std::vector<unsigned> threads(views.size());
  for_each_view(
      views,
      [&](std::size_t i, const Execution& execution) { threads[i] = thread_count(execution.parallel); },
      {Threads{3}, Isa::scalar});
  EXPECT_EQ(threads, (std::vector<unsigned>{3, 1}));
}

TEST(Batch, LetsExceptionsThrough) {
  const auto fail = [](std::size_t, const Execution&) { throw std::runtime_error("no"); };
  EXPECT_THROW(for_each_view(views_of_sizes({1'000'000}), fail, {Threads{2}, Isa::scalar}),
               std::runtime_error);
  EXPECT_THROW(for_each_view(views_of_sizes({10, 20}), fail, {Threads{2}, Isa::scalar}), std::runtime_error);
}

template <typename VolumeT, typename Fit>
void expect_single_fits(const std::vector<Fitted<VolumeT>>& all, const std::vector<PointView>& views,
                        const Fit& fit) {
  ASSERT_EQ(all.size(), views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Fitted<VolumeT> single = fit(views[i]);
    SCOPED_TRACE(i);
    EXPECT_TRUE(*all[i] == *single);
    test::expect_same_result(all[i], single);
  }
}

TEST(Clusters, AreFittedWithTheBitsOfSingleFits) {
  test::TestCloud<float> cloud = test::gaussian<float>(600, 4);
  cloud.xyz[0] = std::numeric_limits<float>::quiet_NaN();
  IndexLists clusters;  // of 300, 200, 3 and no points; the last has only the invalid point
  for (const auto& [begin, end] : {std::pair{0, 300}, {300, 500}, {500, 503}, {503, 503}, {0, 1}}) {
    for (int i = begin; i < end; ++i)
      clusters.indices.push_back(i);
    clusters.offsets.push_back(clusters.indices.size());
  }
  const PointView points = cloud.view();
  const std::vector<PointView> views = subsets(points, clusters);
  for (const Execution& execution : {Execution(), Execution(Threads{3})}) {
    expect_single_fits(fit_aabb(points, clusters, execution), views, [](auto& v) { return fit_aabb(v); });
    expect_single_fits(fit_kdop(points, clusters, KdopSet::dop14(), execution), views,
                       [](auto& v) { return fit_kdop(v, KdopSet::dop14()); });
    expect_single_fits(fit_sphere(points, clusters, SphereMethod::epos6, execution), views,
                       [](auto& v) { return fit_sphere(v, SphereMethod::epos6); });
    expect_single_fits(fit_obb(points, clusters, ObbMethod::yaw, execution), views,
                       [](auto& v) { return fit_obb(v, ObbMethod::yaw); });
    expect_single_fits(fit_obb(points, clusters, ObbMethod::pca, execution), views,
                       [](auto& v) { return fit_obb(v, ObbMethod::pca); });
    expect_single_fits(fit_prism(points, clusters, {}, execution), views,
                       [](auto& v) { return fit_prism(v); });
    expect_single_fits(fit_hull(points, clusters, execution), views, [](auto& v) { return fit_hull(v); });
    expect_single_fits(fit_cylinder(points, clusters, execution), views,
                       [](auto& v) { return fit_cylinder(v); });
    expect_single_fits(fit_capsule(points, clusters, execution), views,
                       [](auto& v) { return fit_capsule(v); });
    expect_single_fits(fit_ellipsoid(points, clusters, execution), views,
                       [](auto& v) { return fit_ellipsoid(v); });
  }
}

TEST(Clusters, WithIndicesOutsideTheCloudAreRefused) {
  const test::TestCloud<float> cloud = test::gaussian<float>(10, 4);
  const IndexLists clusters{{0, 1, 10}, {0, 2, 3}};
  EXPECT_THROW(fit_obb(cloud.view(), clusters), std::out_of_range);
  EXPECT_TRUE(fit_obb(cloud.view(), IndexLists()).empty());
}

}  // namespace
}  // namespace pcl_bv::detail
