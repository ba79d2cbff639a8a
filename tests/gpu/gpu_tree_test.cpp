// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Compares trees on a device with a PointTree, which its own tests compare with all points one by one.

#include "pcl_bv/gpu/gpu_tree.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <thread>

#include "../trees/each_point.h"
#include "device_tree.h"
#include "gpu_test.h"
#include "radix_sort.h"
#include "tree_queries.h"

namespace pcl_bv::testing {
namespace {

using test::TestCloud;

// Queries of all kinds.
struct TestQueries {
  std::vector<double> positions;
  std::vector<Sphere> spheres;
  std::vector<MovingSphere> moving;
  double max_distance = 0;

  TestQueries(const PointView& cloud, std::size_t count, std::uint64_t seed) {
    const EachPoint points(cloud);
    Questions questions(points, seed);
    max_distance = questions.distance(questions.place());
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d place = questions.place(), center = questions.place(), origin = questions.place();
      positions.insert(positions.end(), {place.x(), place.y(), place.z()});
      spheres.emplace_back(center, questions.distance(center));
      const double radius = questions.uniform(0, 1) < 0.2 ? 0 : questions.distance(origin) * 0.1;
      moving.push_back({origin, questions.direction(), radius});
    }
  }
  PointView view() const { return PointView::of(positions.data(), 24, positions.size() / 3); }
};

void expect_same_results(const GpuTree& tree, const PointTree& expected, const TestQueries& queries,
                         const Execution& execution = {}) {
  EXPECT_EQ(tree.size(), expected.size());
  EXPECT_EQ(tree.dropped(), expected.dropped());
  std::vector<Neighbor> found, near;
  for (const double distance : {kInfinity, queries.max_distance, 0.0}) {
    nearest(tree, queries.view(), found, distance, execution);
    nearest(expected, queries.view(), near, distance);
    EXPECT_EQ(found, near) << "within " << distance;
  }
  std::vector<std::uint8_t> inside, in_spheres;
  any_inside(tree, queries.spheres, inside, execution);
  any_inside(expected, queries.spheres, in_spheres);
  EXPECT_EQ(inside, in_spheres);
  std::vector<std::optional<PointHit>> hits;
  first_hit(tree, queries.moving, hits, execution);
  ASSERT_EQ(hits.size(), queries.moving.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const MovingSphere& sphere = queries.moving[i];
    const auto hit = expected.first_hit(sphere.origin, sphere.direction, sphere.radius);
    ASSERT_EQ(hits[i].has_value(), hit.has_value()) << i << ", radius " << sphere.radius;
    if (!hit) continue;
    EXPECT_EQ(hits[i]->t, hit->t) << i;
    EXPECT_EQ(hits[i]->index, hit->index) << i;
  }
}

TEST(GpuTree, HasTheResultsOfAPointTreeOnNastyClouds) {
  PCL_BV_NEEDS_DEVICE();
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    expect_same_results(GpuTree(GpuCloud(test::small_buffers(), cloud.view())), PointTree(cloud.view()),
                        TestQueries(cloud.view(), 100, 1));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(GpuTree, HasTheResultsOfAPointTreeForEverySize) {
  PCL_BV_NEEDS_DEVICE();
  for (const std::size_t size : {0, 1, 15, 16, 17, 255, 256, 257, 4095, 4096, 4097, 70'000}) {
    SCOPED_TRACE(size);
    const TestCloud<float> cloud = test::gaussian<float>(size, size, 10, 50);
    expect_same_results(GpuTree(GpuCloud(test::small_buffers(), cloud.view())), PointTree(cloud.view()),
                        TestQueries(cloud.view(), 100, size));
  }
}

TEST(GpuTree, HasTheResultsOfAPointTreeForACloudInSeveralBuffers) {
  PCL_BV_NEEDS_DEVICE();
  TestCloud<float> cloud = test::gaussian<float>(200'000, 3, 20);
  for (std::size_t i = 0; i < cloud.xyz.size(); i += 1 + i / 3)
    cloud.xyz[i] = std::numeric_limits<float>::quiet_NaN();
  const GpuCloud on_device(test::small_buffers(), cloud.view(), HostPoints::release);
  ASSERT_GT(on_device.on_device().parts().size(), 1U);
  const PointTree expected(cloud.view());
  const GpuTree tree(on_device);
  expect_same_results(tree, expected, TestQueries(cloud.view(), 300, 4), {Threads{3}});
}

TEST(GpuTree, RunsMoreQueriesThanFitInABuffer) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud = test::gaussian<float>(5000, 3, 20);
  const TestQueries queries(cloud.view(), 30'000, 4);
  std::vector<std::uint8_t> inside, expected;
  any_inside(GpuTree(GpuCloud(test::small_buffers(), cloud.view())), queries.spheres, inside, {Threads{3}});
  any_inside(PointTree(cloud.view()), queries.spheres, expected);
  EXPECT_EQ(inside, expected);
}

TEST(GpuTree, NamesPointsByTheirIndicesInTheCloud) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud = test::gaussian<float>(3000, 5);
  std::vector<std::int32_t> chosen;
  for (std::int32_t i = 2999; i > 0; i -= 3)
    chosen.push_back(i);
  const TestQueries queries(cloud.view(), 200, 6);
  for (const PointView& view : {cloud.view().subset(chosen), cloud.view().slice(1000, 700)})
    expect_same_results(GpuTree(GpuCloud(test::small_buffers(), view)), PointTree(view), queries);
}

TEST(GpuTree, FindsTheSmallestIndexAmongEqualPoints) {
  PCL_BV_NEEDS_DEVICE();
  TestCloud<float> cloud = test::gaussian<float>(100, 7);
  for (int copies = 0; copies < 4; ++copies) {
    const std::vector<float> more(cloud.xyz.begin(), cloud.xyz.begin() + 300);
    cloud.xyz.insert(cloud.xyz.end(), more.begin(), more.end());
  }
  expect_same_results(GpuTree(GpuCloud(test::small_buffers(), cloud.view())), PointTree(cloud.view()),
                      TestQueries(cloud.view(), 500, 8));
}

struct Candidates {
  std::size_t candidates = 0, many = 0;
};

Candidates candidates_for(const GpuTree& tree, const PointView& positions) {
  Candidates sum;
  run_queries(
      tree.on_device(), QueryKind::nearest, positions.count, {},
      [&](std::size_t i) {
        auto query = query_at(tree.on_device(), load_point(positions, i), 0);
        query->limit = 1e30F;
        return *query;
      },
      [&](std::size_t, const TreePart&, const DeviceResult& result) {
        if (result.candidates == DeviceResult::kMany) {
          ++sum.many;
        } else {
          sum.candidates += result.candidates;
        }
      });
  return sum;
}

TEST(GpuTree, RunsMostQueriesOnTheDevice) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud = test::gaussian<float>(50'000, 9, 20);
  const TestCloud<float> positions = test::gaussian<float>(2000, 10, 20);
  const Candidates sum =
      candidates_for(GpuTree(GpuCloud(test::small_buffers(), cloud.view())), positions.view());
  EXPECT_EQ(sum.many, 0U);
  EXPECT_LT(sum.candidates, positions.size() * 11 / 10);
}

TEST(GpuTree, RunsMostQueriesOnTheDeviceThoughAPointIsFarAway) {
  PCL_BV_NEEDS_DEVICE();
  TestCloud<float> cloud = test::gaussian<float>(50'000, 9, 20);
  cloud.xyz[3 * 777] = 1e9F;
  const TestCloud<float> positions = test::gaussian<float>(2000, 10, 20);
  const GpuTree tree(GpuCloud(test::small_buffers(), cloud.view()));
  const Candidates sum = candidates_for(tree, positions.view());
  EXPECT_EQ(sum.many, 0U);
  EXPECT_LT(sum.candidates, positions.size() * 11 / 10);
  expect_same_results(tree, PointTree(cloud.view()), TestQueries(cloud.view(), 200, 18));
}

TEST(GpuTree, HasTheResultsOfAPointTreeWhereParametersAreRoundedToTheSameNumber) {
  PCL_BV_NEEDS_DEVICE();
  const Vector3d zero = Vector3d::Zero(), x = Vector3d::UnitX();
  const TestCloud<float> cloud{"two points", {20, 0, 0, 10, 0, 0}};
  const GpuTree tree(GpuCloud(test::small_buffers(), cloud.view()));
  std::vector<std::optional<PointHit>> hits;
  for (const double length : {1e-320, 1e-300, 1e-200, 1.0, 1e200, 1e300, 1e308}) {
    SCOPED_TRACE(length);
    first_hit(tree, {{zero, length * x, 0.1}}, hits);
    const auto expected = PointTree(cloud.view()).first_hit(zero, length * x, 0.1);
    ASSERT_TRUE(hits[0] && expected);
    EXPECT_EQ(hits[0]->index, expected->index);
    EXPECT_EQ(hits[0]->t, expected->t);
  }
}

TEST(GpuTree, RunsQueriesOfSeveralThreadsAtATime) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud{"equal points", std::vector<float>(3 * 5000, 0.1F)};
  const GpuTree tree(GpuCloud(test::small_buffers(), cloud.view()));
  const PointTree expected(cloud.view());
  const TestQueries queries(cloud.view(), 50, 19);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] { expect_same_results(tree, expected, queries, {Threads{2}}); });
  for (std::thread& thread : threads)
    thread.join();
}

TEST(GpuTree, HasTheResultsOfANewTreeAfterARefit) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> before = test::gaussian<float>(100'000, 11, 20);
  TestCloud<float> after = before;
  for (float& x : after.xyz)
    x = 1.5F * x + 3;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < 3000; i += 7)
    after.xyz[i] = nan;
  GpuTree tree(GpuCloud(test::small_buffers(), before.view()));
  const TestQueries queries(after.view(), 300, 12);
  tree.refit(GpuCloud(test::small_buffers(), after.view()));
  expect_same_results(tree, PointTree(after.view()), queries);
  tree.refit(GpuCloud(test::small_buffers(), before.view()));
  expect_same_results(tree, PointTree(before.view()), queries);
  for (float& x : after.xyz)
    x += 5e5F;  // far from the centre of the first cloud
  tree.refit(GpuCloud(test::small_buffers(), after.view()));
  expect_same_results(tree, PointTree(after.view()), TestQueries(after.view(), 300, 12));
}

TEST(GpuTree, RefusesWrongArguments) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<double> doubles = test::gaussian<double>(10, 13);
  const TestCloud<float> floats = test::gaussian<float>(10, 13), fewer = test::gaussian<float>(9, 13);
  const GpuDevice& device = test::small_buffers();
  EXPECT_THROW(GpuTree(GpuCloud(device, doubles.view())), std::invalid_argument);
  PointView far = floats.view();
  far.first = std::numeric_limits<std::int32_t>::max() - std::size_t{9};
  EXPECT_THROW(GpuTree(GpuCloud(device, far)), std::invalid_argument);
  GpuTree tree{GpuCloud(device, floats.view())};
  EXPECT_THROW(tree.refit(GpuCloud(device, doubles.view())), std::invalid_argument);
  EXPECT_THROW(tree.refit(GpuCloud(device, fewer.view())), std::invalid_argument);
  EXPECT_THROW(tree.refit(GpuCloud(GpuDevice("0"), floats.view())), std::invalid_argument);
  std::vector<Neighbor> found;
  EXPECT_THROW(nearest(tree, floats.view(), found, -1), std::invalid_argument);
  EXPECT_THROW(nearest(tree, floats.view(), found, std::nan("")), std::invalid_argument);
  std::vector<std::optional<PointHit>> hits;
  EXPECT_THROW(first_hit(tree, {{Vector3d::Zero(), Vector3d::UnitX(), -1}}, hits), std::invalid_argument);
  EXPECT_THROW(first_hit(tree, {{Vector3d::Zero(), Vector3d::UnitX(), 1e101}}, hits), std::invalid_argument);
}

TEST(GpuTree, FindsNothingForQueriesThatAreNotFinite) {
  PCL_BV_NEEDS_DEVICE();
  const TestCloud<float> cloud = test::gaussian<float>(1000, 14);
  const GpuTree tree(GpuCloud(test::small_buffers(), cloud.view()));
  const std::vector<double> places = {kInfinity, 0, 0, 0, std::nan(""), 0, 1e300, 0, 0};
  std::vector<Neighbor> found;
  nearest(tree, PointView::of(places.data(), 24, 3), found);
  EXPECT_EQ(found, std::vector<Neighbor>(3, {-1, kInfinity}));
  std::vector<std::uint8_t> inside;
  any_inside(tree, {Sphere(), Sphere(Vector3d::Zero(), 1e90)}, inside);
  EXPECT_EQ(inside, (std::vector<std::uint8_t>{0, 1}));
  const Vector3d zero = Vector3d::Zero(), x = Vector3d::UnitX();
  std::vector<std::optional<PointHit>> hits;
  first_hit(tree,
            {{zero, kInfinity * x, 1}, {std::nan("") * x, x, 1}, {zero, zero, 1e-9}, {zero, 1e-320 * x, 1}},
            hits);
  EXPECT_FALSE(hits[0]);
  EXPECT_FALSE(hits[1]);
  EXPECT_EQ(hits[2].has_value(), PointTree(cloud.view()).first_hit(zero, zero, 1e-9).has_value());
  EXPECT_EQ(hits[3].has_value(), PointTree(cloud.view()).first_hit(zero, 1e-320 * x, 1).has_value());
}

TEST(GpuTree, KeepsTheValidationLayerQuiet) {
  PCL_BV_NEEDS_DEVICE();
  const std::optional<GpuDevice> device = test::validated_device();
  PCL_BV_NEEDS_VALIDATION(device);
  const TestCloud<float> cloud = test::gaussian<float>(100'000, 15);
  GpuTree tree(GpuCloud(*device, cloud.view()));
  expect_same_results(tree, PointTree(cloud.view()), TestQueries(cloud.view(), 100, 16));
  tree.refit(GpuCloud(*device, cloud.view()));
  EXPECT_EQ(device->validation_messages(), std::vector<std::string>());
}

// Sorts on the device and returns the numbers.
std::vector<std::uint32_t> sorted_numbers(const std::vector<std::uint32_t>& keys, std::uint32_t bits) {
  const std::shared_ptr<GpuContext>& context = test::small_buffers().context();
  const std::size_t bytes = 4 * keys.size();
  const SortBuffers buffers(*context, keys.size());
  const ScratchBuffer upload(*context, 2 * bytes, BufferUse::upload),
      numbers(*context, bytes, BufferUse::device), download(*context, bytes, BufferUse::download);
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0U);
  std::memcpy(upload.mapped(), keys.data(), bytes);
  std::memcpy(upload.mapped() + bytes, order.data(), bytes);
  Submission submission(context);
  submission.copy(upload, 0, buffers.keys(), 0, bytes);
  submission.copy(upload, bytes, numbers, 0, bytes);
  sort_by_keys(submission, *context, buffers, numbers, static_cast<std::uint32_t>(keys.size()), bits);
  submission.copy(numbers, 0, download, 0, bytes);
  submission.run();
  std::memcpy(order.data(), download.mapped(), bytes);
  return order;
}

TEST(RadixSort, OrdersNumbersAsAStableSort) {
  PCL_BV_NEEDS_DEVICE();
  std::mt19937_64 random(17);
  for (const std::size_t size : {1, 63, 64, 1023, 1024, 1025, 5000, 250'000}) {
    for (const std::uint32_t bits : {8U, 16U, 24U, 32U}) {
      SCOPED_TRACE(std::to_string(size) + " keys of " + std::to_string(bits) + " bits");
      std::vector<std::uint32_t> keys(size), order(size);
      for (std::uint32_t& key : keys)
        key = static_cast<std::uint32_t>(random() >> (64 - bits));
      std::iota(order.begin(), order.end(), 0U);
      std::stable_sort(order.begin(), order.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
      EXPECT_EQ(sorted_numbers(keys, bits), order);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::testing
