// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clouds.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/points/point_source.h"

namespace pcl_bv::detail {
namespace {

using test::TestCloud;

using Triple = std::array<long double, 3>;

// Two passes in long double, whose own error (2^-64 a step) is far below what is promised.
struct Brute {
  explicit Brute(const PointView& points, double scale) {
    for (std::size_t i = 0; i < points.count; ++i) {
      const Coordinates p = load_point(points, i);
      if (!is_valid(p)) continue;
      if (valid.empty()) origin = {p.x, p.y, p.z};
      valid.push_back({p.x - origin[0], p.y - origin[1], p.z - origin[2]});
    }
    const auto n = static_cast<long double>(valid.size());
    for (const Triple& p : valid)
      for (std::size_t k = 0; k < 3; ++k)
        mean[k] += p[k] / n;
    for (const Triple& p : valid)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          covariance[i][j] += (p[i] - mean[i]) * scale * ((p[j] - mean[j]) * scale) / n;
  }
  std::vector<Triple> valid;
  Triple origin{}, mean{};
  std::array<Triple, 3> covariance{};
};

void expect_accurate(const PointView& points) {
  const CloudSummary summary = summarize(points);
  const Brute brute(points, summary.covariance_scale);
  ASSERT_EQ(summary.used, brute.valid.size());
  ASSERT_EQ(summary.used + summary.dropped, points.count);
  if (brute.valid.empty()) return;
  const double blocks = static_cast<double>(points.count) / kBlockPoints;
  const long double errors = (175 + 30 * std::ceil(std::log2(std::max(blocks, 1.0)))) * 0x1p-53L;
  long double extent[3];
  for (int i = 0; i < 3; ++i) {
    extent[i] = static_cast<long double>(summary.aabb.max()[i]) - summary.aabb.min()[i];
    const long double exact = brute.origin[i] + brute.mean[i];
    EXPECT_LE(std::abs(summary.centroid[i] - exact),
              errors * extent[i] + 0x1p-53L * std::abs(exact) + 0x1p-1074L);
    EXPECT_GE(summary.centroid[i], summary.aabb.min()[i]);
    EXPECT_LE(summary.centroid[i], summary.aabb.max()[i]);
    EXPECT_FALSE(summary.centroid[i] == 0 && std::signbit(summary.centroid[i]));
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const long double bound =
          3 * errors * (extent[i] * summary.covariance_scale) * (extent[j] * summary.covariance_scale) +
          0x1p-1073L;
      EXPECT_LE(std::abs(summary.covariance(i, j) - brute.covariance[i][j]), bound) << i << ", " << j;
      EXPECT_EQ(summary.covariance(i, j), summary.covariance(j, i));
    }
    EXPECT_GE(summary.covariance(i, i), 0);
  }
}

template <typename T>
std::vector<TestCloud<T>> clouds() {
  std::vector<TestCloud<T>> all = test::nasty_clouds<T>();
  all.push_back(test::gaussian<T>(100'000, 1, 20, 5e6));
  TestCloud<T> outlier = test::gaussian<T>(5000, 2, 1, 1000);  // a dead beam comes first, and is the origin
  outlier.name = "first point far away";
  std::fill_n(outlier.xyz.begin(), 3, T(0));
  all.push_back(outlier);
  return all;
}

TEST(Summary, CentroidAndCovarianceAreWithinTheStatedBoundForFloat) {
  for (const TestCloud<float>& cloud : clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    expect_accurate(cloud.view());
  }
}

TEST(Summary, CentroidAndCovarianceAreWithinTheStatedBoundForDouble) {
  std::vector<TestCloud<double>> all = clouds<double>();
  for (const double scale : {1e-310, 1e-200, 1e-160, 1e-101, 1e-99, 1e99})
    all.push_back(test::gaussian<double>(700, 7, scale / 5));
  TestCloud<double> narrow = test::gaussian<double>(700, 8);
  narrow.name = "one axis so narrow that its squares underflow";
  for (std::size_t i = 1; i < narrow.xyz.size(); i += 3)
    narrow.xyz[i] *= 1e-160;
  all.push_back(narrow);
  TestCloud<double> jagged{"rounded squares whose mean is less than the square of the mean", {0, 0, 0}};
  for (int i = 0; i < 8; ++i)
    jagged.xyz.insert(jagged.xyz.end(), {1, 0, 0.7 * 0x1p-537, 0, 1, 1.22 * 0x1p-537});
  all.push_back(jagged);
  for (const TestCloud<double>& cloud : all) {
    SCOPED_TRACE(cloud.name);
    expect_accurate(cloud.view());
  }
}

}  // namespace
}  // namespace pcl_bv::detail
