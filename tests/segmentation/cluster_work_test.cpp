// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clouds and settings that make a clusterer slow. The sources of the clusterer are compiled for this test
// with a call at the start of each basic block, which is the unit of work. So the test has the same result on
// every machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "pcl_bv/segmentation/class_clusters.h"
#include "reference.h"

namespace {
std::size_t work = 0;
}

extern "C" void __sanitizer_cov_trace_pc() {  // NOLINT(bugprone-reserved-identifier): the compiler's name
  ++work;
}

namespace pcl_bv::detail {
namespace {

using Cloud = test::Cloud<double>;

struct Maker {
  const char* name;
  std::function<Cloud(std::size_t)> make;
};

class Random {
 public:
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double magnitude(double low, double high) { return std::pow(10, (*this)(low, high)) * (*this)(-1, 1); }

 private:
  std::mt19937_64 engine_{1};
};

Cloud each(std::size_t n, const std::function<std::array<double, 3>(std::size_t, Random&)>& point) {
  Random random;
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i)
    cloud.push_back(point(i, random));
  return cloud;
}

std::array<double, 3> inside(Random& r, double half, double at = 0) {
  return {at + r(-half, half), at + r(-half, half), at + r(-half, half) / 20};
}

const std::vector<Maker>& makers() {
  static const std::vector<Maker> all{
      {"street", [](std::size_t n) { return each(n, [](auto, Random& r) { return inside(r, 40); }); }},
      {"outliers of all magnitudes",
       [](std::size_t n) {
         return each(n, [](std::size_t i, Random& r) {
           return inside(r, i % 20 == 0 ? 40 * r.magnitude(0, 36) : 40);
         });
       }},
      {"all magnitudes",
       [](std::size_t n) {
         return each(n, [](auto, Random& r) { return inside(r, r.magnitude(-30, 36)); });
       }},
      {"all magnitudes on each axis",
       [](std::size_t n) {
         return each(n, [](auto, Random& r) -> std::array<double, 3> {
           return {r.magnitude(-30, 36), r.magnitude(-30, 36), r.magnitude(-30, 36)};
         });
       }},
      {"exponential diagonal",
       [](std::size_t n) {
         return each(n, [n](std::size_t i, Random&) -> std::array<double, 3> {
           const double x = std::pow(10, -30 + 66 * static_cast<double>(i) / static_cast<double>(n));
           return {x, x, x};
         });
       }},
      {"copies",
       [](std::size_t n) {
         return each(n, [](std::size_t i, Random&) {
           Random r;
           return inside(r, static_cast<double>(i % 50));
         });
       }},
      {"one place", [](std::size_t n) { return each(n, [](auto, Random& r) { return inside(r, 0.1, 5); }); }},
      {"line",
       [](std::size_t n) {
         return each(n, [n](std::size_t i, Random&) -> std::array<double, 3> {
           return {80 * static_cast<double>(i) / static_cast<double>(n), 0, 0};
         });
       }},
      {"lattice of the tolerance",
       [](std::size_t n) { return test::lattice(static_cast<int>(std::cbrt(static_cast<double>(n))), 0.5); }},
      {"far away",
       [](std::size_t n) { return each(n, [](auto, Random& r) { return inside(r, 50, 7e12); }); }},
      {"two places far apart",
       [](std::size_t n) {
         return each(n, [](std::size_t i, Random& r) { return inside(r, 50, i % 2 ? 0 : 3e11); });
       }},
      {"outliers seen from their middle",
       [](std::size_t n) {
         return each(n, [](std::size_t i, Random& r) {
           return inside(r, i % 100 == 0 ? 40 * r.magnitude(0, 36) : 40, 5e35);
         });
       }},
  };
  return all;
}

std::size_t work_of(const Cloud& cloud, const ClusterOptions& options) {
  EuclideanClusterer clusterer;
  Clusters clusters;
  work = 0;
  clusterer.extract(test::view_of(cloud), options, clusters);
  return work;
}

double n_log_n(std::size_t n) {
  return static_cast<double>(n) * std::log2(static_cast<double>(n));
}

// 16 times the points of n^2 work would take 256 times the work.
void expect_near_linear(const char* what, const std::function<ClusterOptions(std::size_t)>& options) {
  for (const Maker& maker : makers()) {
    const Cloud few = maker.make(1000), many = maker.make(16'000);
    const double small = static_cast<double>(work_of(few, options(few.size()))) / n_log_n(few.size());
    const double large = static_cast<double>(work_of(many, options(many.size()))) / n_log_n(many.size());
    EXPECT_LT(large, 2 * small + 20) << what << ", " << maker.name;
    EXPECT_LT(large, 400) << what << ", " << maker.name;
  }
}

TEST(ClusterWork, IsCounted) {
  EXPECT_GT(work_of(makers().front().make(100), {0.5F}), 100U);
}

TEST(ClusterWork, GrowsAsNLogNAtEveryTolerance) {
  for (const float tolerance : {1e-22F, 1e-6F, 0.05F, 0.5F, 20.F, 1e20F})
    expect_near_linear(std::to_string(tolerance).c_str(), [&](auto) { return ClusterOptions{tolerance}; });
}

TEST(ClusterWork, GrowsAsNLogNIfTheToleranceGrowsWithTheRange) {
  for (const float per_metre : {1e-9F, 0.02F, 0.3F, 5.F}) {
    expect_near_linear(std::to_string(per_metre).c_str(), [&](auto) {
      ClusterOptions options{0.5F};
      options.tolerance_per_metre = per_metre;
      return options;
    });
  }
}

TEST(ClusterWork, GrowsAsNLogNIfLargeClustersAreSplit) {
  for (const float per_metre : {0.F, 0.02F}) {
    expect_near_linear("split", [&](std::size_t n) {
      ClusterOptions options{0.5F};
      options.tolerance_per_metre = per_metre;
      options.oversized = Oversized::split;
      options.max_size = n / 20;
      return options;
    });
  }
}

TEST(ClusterWork, GrowsAsNLogNWithDbscan) {
  for (const std::size_t min_points : {2U, 10U}) {
    expect_near_linear("min_points", [&](auto) {
      ClusterOptions options{0.5F};
      options.min_points = min_points;
      return options;
    });
  }
}

// All points are in a ball of the size of the tolerance. Half of them are core points. n^2 would be 256
// times.
TEST(ClusterWork, GrowsBelowN2IfDbscanNeedsAFractionOfThePoints) {
  const auto work_of_n = [](std::size_t n) {
    ClusterOptions options{0.1F};
    options.min_points = n / 3;
    return work_of(each(n,
                        [](auto, Random& r) -> std::array<double, 3> {
                          return {r(-0.1, 0.1), r(-0.1, 0.1), r(-0.1, 0.1)};
                        }),
                   options);
  };
  EXPECT_LT(work_of_n(16'000), 13 * work_of_n(4000));
}

TEST(ClusterWork, GrowsAsNLogNIfEachPointHasItsOwnClass) {
  const auto work_of_n = [](std::size_t n) {
    const Cloud cloud = makers().front().make(n);
    std::vector<std::int64_t> classes, class_of;
    for (std::size_t i = 0; i < n; ++i)
      classes.push_back(static_cast<std::int64_t>((i * 7919) % n));
    ClassClusterer clusterer;
    Clusters clusters;
    work = 0;
    clusterer.extract(test::view_of(cloud), classes, {0.5F}, {}, clusters, class_of);
    EXPECT_EQ(clusters.size(), n);
    return static_cast<double>(work) / n_log_n(n);
  };
  EXPECT_LT(work_of_n(16'000), 2 * work_of_n(1000));
}

}  // namespace
}  // namespace pcl_bv::detail
