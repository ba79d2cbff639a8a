// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What a stream of sweeps asks of the clusterer: the same bits from any number of threads, and no memory once
// it is warm.
#include <gtest/gtest.h>

#include <latch>
#include <optional>
#include <vector>

#include "allocations.h"
#include "flush_to_zero.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/segmentation/class_clusters.h"
#include "pcl_bv/synth/street.h"
#include "reference.h"

namespace {

using namespace pcl_bv;
using namespace pcl_bv::detail;
using namespace pcl_bv::test;

PointView view_of(const SynthCloud& cloud) {
  return PointView::of(cloud.xyz.data(), 12, cloud.size());
}

std::vector<SynthCloud> sweeps() {
  std::vector<SynthCloud> frames;
  for (const std::size_t points : {64'000U, 24'000U, 128'000U}) {
    StreetOptions options;
    options.points = points;
    frames.push_back(make_street_frame(options, frames.size()).cloud);
  }
  return frames;
}

template <typename View>
void expect_the_same_from_threads(const View& points, float tolerance, std::size_t min_points) {
  SCOPED_TRACE(testing::Message() << points.count << " points, tolerance " << tolerance << ", min_points "
                                  << min_points);
  ClusterOptions settings{tolerance};
  settings.min_points = min_points;
  Clusters serial, threaded;
  EuclideanClusterer clusterer;
  clusterer.extract(points, settings, serial);
  for (const unsigned threads : {2U, 3U, 5U}) {
    for (const ParallelPolicy& policy : {ParallelPolicy(OpenMP{threads}), ParallelPolicy(Threads{threads})}) {
      SCOPED_TRACE(threads);
      clusterer.extract(points, settings, threaded, policy);
      EXPECT_EQ(threaded.indices, serial.indices);
      EXPECT_EQ(threaded.offsets, serial.offsets);
      EXPECT_EQ(threaded.noise_points, serial.noise_points);
    }
  }
}

template <typename View>
void expect_the_same_from_threads(const View& points, float tolerance) {
  for (const std::size_t min_points : {1U, 2U, 8U})
    expect_the_same_from_threads(points, tolerance, min_points);
}

TEST(ClustersInAStream, AreTheSameFromAnyNumberOfThreads) {
  for (const SynthCloud& sweep : sweeps()) {
    for (const float r : {0.1F, 0.3F, 1.F})
      expect_the_same_from_threads(view_of(sweep), r);
  }
  // Sheets that take long to tell apart, doubles whose cells are joined point by point, keys beyond 64 bits.
  Cloud<float> sheets = uniform_cloud(60'000, 12.F, 3);
  for (std::size_t i = 0; i < sheets.size(); ++i)
    sheets[i][2] = i % 2 ? 0.F : 0.505F;
  expect_the_same_from_threads(test::view_of(sheets), 0.5F);
  expect_the_same_from_threads(test::view_of(uniform_cloud(30'000, 1e-3, 4, {4e5, 5e6, 100.0})), 5e-5F);
  Cloud<float> wide = uniform_cloud(30'000, 1.F, 5);
  wide.push_back({3e37F, -3e37F, 3e37F});
  expect_the_same_from_threads(test::view_of(wide), 0.02F);
}

thread_local std::optional<FlushToZero> flush_to_zero;

// Calls body in each of three threads of OpenMP's pool, this one among them: none leaves before all are
// there.
template <typename Body>
void in_each_thread(Body body) {
  constexpr unsigned threads = 3;
  std::latch arrived(threads);
  for_each_chunk(OpenMP{threads}, threads, [&](std::size_t) {
    arrived.arrive_and_wait();
    body();
  });
}

TEST(ClustersInAStream, KeepDenormalsOnThreadsThatFlushThem) {
  const Cloud<float> cloud = uniform_cloud(30'000, 1e-19F, 6);
  Clusters expected, found;
  EuclideanClusterer().extract(test::view_of(cloud), {5e-22F}, expected);
  EXPECT_LT(expected.size(), cloud.size());
  in_each_thread([] { flush_to_zero.emplace(); });
  EuclideanClusterer().extract(test::view_of(cloud), {5e-22F}, found, OpenMP{3});
  in_each_thread([] { flush_to_zero.reset(); });
  EXPECT_EQ(found.indices, expected.indices);
  EXPECT_EQ(found.offsets, expected.offsets);
}

TEST(ClustersInAStream, TakeNoMemoryInTheSecondPass) {
  const std::vector<SynthCloud> frames = sweeps();
  for (const ParallelPolicy& policy :
       {ParallelPolicy(Serial{}), ParallelPolicy(OpenMP{2}), ParallelPolicy(Threads{2})}) {
    EuclideanClusterer clusterer;
    Clusters clusters;
    std::size_t before = 0;
    for (int pass = 0; pass < 3; ++pass) {
      if (pass == 1) before = allocations();
      for (const SynthCloud& frame : frames) {
        for (const float r : {0.1F, 0.5F}) {
          for (const std::size_t min_points : {1U, 6U}) {
            ClusterOptions settings{r, 10};
            settings.min_points = min_points;
            clusterer.extract(view_of(frame), settings, clusters, policy);
          }
        }
      }
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_GT(clusters.size(), 10U);
  }
}

TEST(ClustersInAStream, TakeNoMemoryInTheSecondPassWithGrowthSplitsAndClasses) {
  const std::vector<SynthCloud> frames = sweeps();
  for (const ParallelPolicy& policy : {ParallelPolicy(Serial{}), ParallelPolicy(Threads{2})}) {
    EuclideanClusterer clusterer;
    ClassClusterer class_clusterer;
    Clusters clusters;
    std::vector<std::int64_t> classes, class_of;
    for (std::size_t i = 0; i < 128'000; ++i)
      classes.push_back(static_cast<std::int64_t>(i / 1000 % 5));
    ClusterOptions settings{0.3F, 10, 2000};
    settings.oversized = Oversized::split;
    ClusterOptions grown = settings;
    grown.tolerance_per_metre = 0.02F;
    std::size_t before = 0;
    for (int pass = 0; pass < 3; ++pass) {
      if (pass == 1) before = allocations();
      for (const SynthCloud& frame : frames) {
        clusterer.extract(view_of(frame), settings, clusters, policy);
        clusterer.extract(view_of(frame), grown, clusters, policy);
        const std::size_t own = allocations();
        const std::vector<ClassOptions> rules = {{1, settings, true}, {2, grown}, {3, {0.2F, 5}}};
        before += pass > 0 ? allocations() - own : 0;
        class_clusterer.extract(view_of(frame), classes, settings, rules, clusters, class_of, policy);
      }
    }
    EXPECT_EQ(allocations(), before);
    EXPECT_GT(clusters.size(), 10U);
  }
}

// Two full cells that are compared point by point, if they are neighbours, and lone points for more than one
// thread.
Cloud<float> with_two_full_cells(float apart) {
  Cloud<float> cloud;
  for (int i = 0; i < 5000; ++i)
    cloud.push_back({100.F + 10 * static_cast<float>(i), 0, 0});
  for (int i = 0; i < 500; ++i) {
    const float t = 0.1F + 0.0016F * static_cast<float>(i);
    cloud.push_back({t, 1 - t, 0.5F});
    cloud.push_back({apart + t, apart + 1 - t, 0.5F});
  }
  return cloud;
}

TEST(ClustersInAStream, TakeNoMemoryWhereFullCellsBecomeNeighbours) {
  for (const ParallelPolicy& policy : {ParallelPolicy(OpenMP{2}), ParallelPolicy(Threads{2})}) {
    EuclideanClusterer clusterer;
    Clusters clusters;
    const Cloud<float> far = with_two_full_cells(20), near = with_two_full_cells(2);
    for (int pass = 0; pass < 2; ++pass)
      clusterer.extract(test::view_of(far), {1.7321F}, clusters, policy);
    EXPECT_EQ(clusters.size(), 5002U);
    const std::size_t before = allocations();
    clusterer.extract(test::view_of(near), {1.7321F}, clusters, policy);
    EXPECT_EQ(allocations(), before);
    EXPECT_EQ(clusters.size(), 5002U);
  }
}

}  // namespace
