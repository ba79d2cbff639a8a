// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/fitting/fit.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "clouds.h"
#include "executions.h"
#include "fits.h"
#include "flush_to_zero.h"
#include "numbers.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_groups.h"

namespace pcl_bv::detail {
namespace {

using test::bits;
using test::TestCloud;

// Bits, not values.
void expect_same(const CloudSummary& a, const CloudSummary& b) {
  EXPECT_EQ(a.used, b.used);
  EXPECT_EQ(a.dropped, b.dropped);
  EXPECT_EQ(bits(a.aabb), bits(b.aabb));
  EXPECT_EQ(bits(a.dop26), bits(b.dop26));
  EXPECT_EQ(a.covariance_scale, b.covariance_scale);
  EXPECT_EQ(std::memcmp(a.centroid.data(), b.centroid.data(), 3 * sizeof(double)), 0)
      << a.centroid.transpose() << " and " << b.centroid.transpose();
  EXPECT_EQ(std::memcmp(a.covariance.data(), b.covariance.data(), 9 * sizeof(double)), 0)
      << a.covariance << "\nand\n"
      << b.covariance;
}

TEST(Summary, SameBitsForEveryInstructionSetThreadCountAndLayout) {
  std::vector<TestCloud<float>> all = test::nasty_clouds<float>();
  all.push_back(test::gaussian<float>(1'100'000, 77, 20, 5e6));  // threaded on every set
  for (const TestCloud<float>& cloud : all) {
    const CloudSummary expected = summarize(cloud.view(), {Serial{}, Isa::scalar});
    for (const auto& [name, execution] : test::every_execution()) {
      SCOPED_TRACE(cloud.name + ", " + name);
      expect_same(summarize(cloud.view(), execution), expected);
    }
    SCOPED_TRACE(cloud.name);
    expect_same(summarize(test::Records<float>(cloud, 16).view()), expected);
    expect_same(summarize(PointGroups(cloud.view()).view()), expected);
  }
}

TEST(Summary, SameBitsForEveryInstructionSetOfDoublesAlsoTinyOnes) {
  std::vector<TestCloud<double>> all = test::nasty_clouds<double>();
  all.push_back(test::gaussian<double>(70'000, 3, 1e-160));
  for (const TestCloud<double>& cloud : all) {
    const CloudSummary expected = summarize(cloud.view(), {Serial{}, Isa::scalar});
    for (const Isa isa : usable_isas()) {
      SCOPED_TRACE(cloud.name + ", " + std::string(isa_name(isa)));
      expect_same(summarize(cloud.view(), {Serial{}, isa}), expected);
    }
  }
}

TEST(Summary, GivesTheVolumesThatFitsGive) {
  for (const TestCloud<float>& cloud : test::nasty_clouds<float>()) {
    SCOPED_TRACE(cloud.name);
    const CloudSummary summary = summarize(cloud.view());
    Aabb box;
    Kdop kdop;
    const EstimationResult boxed = test::take(fit_aabb(cloud.view()), box);
    const EstimationResult fitted = test::take(fit_kdop(cloud.view(), KdopSet::dop26()), kdop);
    EXPECT_EQ(summary.aabb.empty(), box.empty());
    if (!box.empty()) {
      EXPECT_EQ(summary.aabb.min(), box.min());
      EXPECT_EQ(summary.aabb.max(), box.max());
    }
    const Kdop from_summary = summary.dop26;
    ASSERT_EQ(from_summary.set(), KdopSet::dop26());
    for (std::size_t k = 0; k < kdop.size(); ++k) {
      EXPECT_EQ(from_summary.min(k), kdop.min(k));
      EXPECT_EQ(from_summary.max(k), kdop.max(k));
    }
    EXPECT_EQ(summary.status, fitted.status);
    EXPECT_EQ(summary.rank, fitted.rank);
    EXPECT_EQ(summary.used, boxed.used);
    EXPECT_EQ(summary.dropped, boxed.dropped);
  }
}

TEST(Summary, IsExactWhereTheSumsAre) {
  const float corners[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                           -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
  const CloudSummary cube = summarize(PointView::of(corners, 12, 8));
  EXPECT_EQ(cube.centroid, Eigen::Vector3d::Zero());
  EXPECT_EQ(cube.covariance, Eigen::Matrix3d::Identity()) << "divided by n";
  const float two[] = {1, 10, 5, 5, 4, 5};
  const CloudSummary pair = summarize(PointView::of(two, 12, 2));
  EXPECT_EQ(pair.centroid, Eigen::Vector3d(3, 7, 5));
  Eigen::Matrix3d expected;
  expected << 4, -6, 0, -6, 9, 0, 0, 0, 0;
  EXPECT_EQ(pair.covariance, expected);
}

TEST(Summary, BadPointsAreAsIfAbsent) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const float points[] = {nan, 100, 100, 1, 10, 5, 7, inf, 7, 5, 4, 5, 50, 50, -inf};
  const CloudSummary summary = summarize(PointView::of(points, 12, 5));
  EXPECT_EQ(summary.used, 2U);
  EXPECT_EQ(summary.dropped, 3U);
  EXPECT_EQ(summary.centroid, Eigen::Vector3d(3, 7, 5));
  EXPECT_EQ(summary.covariance(0, 1), -6);
}

TEST(Summary, OfAnIndexListIsThatOfThePointsInItsOrder) {
  const TestCloud<float> cloud = test::gaussian<float>(5000, 6, 3, 100);
  std::vector<std::int32_t> indices(4000);
  TestCloud<float> chosen{"chosen", {}};
  for (std::size_t i = 0; i < indices.size(); ++i) {
    indices[i] = static_cast<std::int32_t>(i * 3 % 5000);
    chosen.xyz.insert(chosen.xyz.end(), &cloud.xyz[3 * indices[i]], &cloud.xyz[3 * indices[i]] + 3);
  }
  const CloudSummary listed = summarize(PointView::of(cloud.xyz.data(), 12, indices.size(), indices.data()));
  const CloudSummary copied = summarize(chosen.view());
  EXPECT_EQ(listed.centroid, copied.centroid);
  EXPECT_EQ(listed.covariance, copied.covariance);
  EXPECT_EQ(bits(listed.dop26), bits(copied.dop26));
}

TEST(Summary, OfNothingIsEmptyAndZero) {
  const float nothing[] = {std::numeric_limits<float>::quiet_NaN(), 1, 2};
  for (const PointView& points : {PointView(), PointView::of(nothing, 12, 1)}) {
    const CloudSummary summary = summarize(points);
    EXPECT_EQ(summary.used, 0U);
    EXPECT_EQ(summary.dropped, points.count);
    EXPECT_EQ(summary.status, EstimationStatus::no_valid_points);
    EXPECT_TRUE(summary.aabb.empty());
    EXPECT_TRUE(summary.dop26.empty());
    EXPECT_EQ(summary.centroid, Eigen::Vector3d::Zero());
    EXPECT_EQ(summary.covariance, Eigen::Matrix3d::Zero());
  }
}

TEST(Summary, OfOnePointIsThatPoint) {
  const double point[] = {5e6, -1e-300, 1e99};
  const CloudSummary summary = summarize(PointView::of(point, 24, 1));
  EXPECT_EQ(summary.centroid, Eigen::Vector3d(5e6, -1e-300, 1e99));
  EXPECT_EQ(summary.covariance, Eigen::Matrix3d::Zero());
  EXPECT_EQ(summary.covariance_scale, 1);
}

TEST(Summary, TinyDoublesAreScaledByAPowerOfTwoAndNothingElse) {
  TestCloud<double> tiny = test::gaussian<double>(3000, 4, 1e-160);
  for (std::size_t i = 2; i < tiny.xyz.size(); i += 3)
    tiny.xyz[i] = 1e100;  // all agree, and would be far out of range if it were scaled, too
  tiny.xyz[300] = std::numeric_limits<double>::quiet_NaN();
  tiny.xyz[3 * 200 + 2] = std::nextafter(1e100, 2e100);
  TestCloud<double> scaled = tiny;
  const CloudSummary summary = summarize(tiny.view());
  int exponent = 0;
  EXPECT_EQ(std::frexp(summary.covariance_scale, &exponent), 0.5);
  EXPECT_GT(summary.covariance_scale, 1);
  for (std::size_t i = 0; i < scaled.xyz.size(); ++i)
    if (i % 3 != 2) scaled.xyz[i] *= summary.covariance_scale;
  EXPECT_EQ(summary.dropped, 2U);
  const CloudSummary expected = summarize(scaled.view());
  EXPECT_EQ(expected.covariance_scale, 1);
  EXPECT_EQ(summary.covariance, expected.covariance);
  EXPECT_GT(summary.covariance(0, 0), 0);
  EXPECT_EQ(summary.centroid.x(), expected.centroid.x() / summary.covariance_scale);
  EXPECT_EQ(summary.centroid.z(), 1e100);
}

TEST(Summary, SurvivesAHostThatFlushesDenormals) {
  const TestCloud<float> cloud = test::gaussian<float>(700, 7, 1e-41);
  const CloudSummary expected = summarize(cloud.view());
  ASSERT_GT(expected.covariance(0, 0), 0);
  for (const auto& [name, execution] : test::every_execution()) {
    SCOPED_TRACE(name);
    CloudSummary summary;
    {
      const test::FlushToZero host;
      summary = summarize(cloud.view(), execution);
    }
    expect_same(summary, expected);
  }
}

TEST(Summary, SurvivesPooledThreadsThatFlushDenormals) {
  const std::thread::id caller = std::this_thread::get_id();
  for_each_chunk(OpenMP{2}, 16, [&](std::size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // lets the others have some
    if (std::this_thread::get_id() == caller) return;
    thread_local const test::FlushToZero host;
    (void)host;
  });
  const TestCloud<float> cloud = test::gaussian<float>(1'100'000, 7, 1e-41);
  expect_same(summarize(cloud.view(), {OpenMP{2}, Isa::automatic}), summarize(cloud.view()));
}

TEST(Summary, AnUnusableInstructionSetIsAnError) {
  const TestCloud<float> cloud = test::gaussian<float>(10, 1);
  const Isa foreign = usable_isas().back() >= Isa::neon ? Isa::avx2 : Isa::neon;
  EXPECT_THROW(summarize(cloud.view(), {Serial{}, foreign}), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::detail
