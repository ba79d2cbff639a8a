// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What is special to spheres; fit_test.cpp holds every method to enclosure and to equal bits.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "allocations.h"
#include "clouds.h"
#include "exact.h"
#include "executions.h"
#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/smallest_sphere.h"
#include "pcl_bv/numeric/float_environment.h"
#include "sphere_clouds.h"

namespace pcl_bv::detail {
namespace {

using test::expect_equal;
using test::points_of;
using test::Rational;
using test::TestCloud;

constexpr SphereMethod kMethods[] = {SphereMethod::ritter, SphereMethod::epos6,  SphereMethod::epos14,
                                     SphereMethod::epos26, SphereMethod::epos98, SphereMethod::exact};
constexpr SphereGrowth kGrowths[] = {SphereGrowth::sequential, SphereGrowth::stationary,
                                     SphereGrowth::deferred};

Sphere fit(const PointView& points, const SphereOptions& options, const Execution& execution = {}) {
  Sphere sphere = *fit_sphere(points, options, execution);
  return sphere;
}

std::vector<TestCloud<float>> clouds_for_certificates() {
  std::vector<TestCloud<float>> clouds = test::nasty_clouds<float>();
  for (const char* shape : {"gauss", "ball", "surface", "hemisphere", "circle", "line", "two clusters"}) {
    for (const std::size_t n : {4, 30, 300, 6000, 40000})
      clouds.push_back(points_of(shape, n));
    clouds.push_back(points_of(shape, 6000, 5e6));
  }
  return clouds;
}

// sum w |p - c|^2 with c = sum w p, for weights that are made to sum to 1: nothing smaller encloses these
// points.
Rational squared_lower_bound(const PointView& points, const SphereCertificate& certificate) {
  Rational sum = 0, squares = 0, mean[3] = {0, 0, 0};
  for (std::size_t i = 0; i < static_cast<std::size_t>(certificate.support_size); ++i) {
    const Coordinates p = load_point(points, certificate.support[i]);
    const double xyz[] = {p.x, p.y, p.z};
    const Rational weight(certificate.weights[i]);
    sum += weight;
    for (int axis = 0; axis < 3; ++axis) {
      mean[axis] += weight * Rational(xyz[axis]);
      squares += weight * Rational(xyz[axis]) * Rational(xyz[axis]);
    }
  }
  Rational bound = squares / sum;
  for (const Rational& m : mean)
    bound -= m / sum * (m / sum);
  return bound;
}

void expect_certified(const PointView& points) {
  Sphere sphere;
  SphereCertificate certificate;
  const EstimationResult result = test::take(fit_smallest_sphere(points), sphere, certificate);
  EXPECT_EQ(verify(sphere, points).outside, 0U);
  if (result.used == 0) {
    EXPECT_EQ(certificate.support_size, 0);
    return;
  }
  ASSERT_GE(certificate.support_size, 1);
  ASSERT_LE(certificate.support_size, 4);
  for (const double weight : certificate.weights)
    EXPECT_GE(weight, 0);
  EXPECT_LE(Rational(certificate.lower_bound) * Rational(certificate.lower_bound),
            squared_lower_bound(points, certificate));
  const double step = 0x1p-52 * sphere.center().norm();  // of the stored centre
  EXPECT_LE(sphere.radius(), certificate.lower_bound * (1 + 1e-12) + step);
  EXPECT_LE(certificate.passes, 12);
}

TEST(SmallestSphere, IsProvenOptimalByItsCertificate) {
  for (const TestCloud<float>& cloud : clouds_for_certificates()) {
    SCOPED_TRACE(cloud.name);
    expect_certified(cloud.view());
  }
  for (const TestCloud<double>& cloud : test::nasty_clouds<double>()) {
    SCOPED_TRACE(cloud.name + ", double");
    expect_certified(cloud.view());
  }
}

// Points near a great circle and one far from it: the support loses one of them when it is solved alone.
TEST(SmallestSphere, IsOptimalIfASupportPointIsNearlyCoplanarWithTheOthers) {
  const TestCloud<double> cloud{
      "ring", {-0x1.e3e4e4b2e8e75p-2, -0x1.a328584cdf1bdp-2, -0x1.8f9a4d117e6c9p-1, -0x1.dd092ea5708e8p-3,
               -0x1.ce87899286c2p-2,  -0x1.b8f37f5caedfp-1,  -0x1.fe938cb0113fdp-1, -0x1.1b8b2283e418ep-5,
               -0x1.0e50b8df73e8p-4,  0x1.bf1666f188c48p-2,  -0x1.abe277a27b366p-2, -0x1.97ec31a52e762p-1,
               0x1.eca97a9a25bf5p-1,  0x1.02f5070ed9955p-3,  0x1.edc09024b0e5p-3,   0x1.9580b8607f05ep-3,
               -0x1.d2320b00b7d5cp-2, -0x1.bc723919de0f4p-1, -0x1.2c7277af3d24ep-8, 0x1.c88609ce073e8p-1,
               -0x1.cf9261e31c766p-2, -0x1.2e2e64ea8261bp-2, 0x1.c66e5b5718b24p-2,  0x1.b13b0677a2975p-1}};
  expect_certified(cloud.view());
}

TEST(SmallestSphere, OfOnePointIsCertifiedByItWithoutAPass) {
  const TestCloud<float> cloud{"one", {1, 2, 3}};
  Sphere sphere;
  SphereCertificate certificate;
  test::take(fit_smallest_sphere(cloud.view()), sphere, certificate);
  EXPECT_EQ(certificate.support_size, 1);
  EXPECT_EQ(certificate.weights[0], 1);
  EXPECT_EQ(certificate.passes, 0);
}

TEST(SmallestSphere, RefusesSupportsThatSayTooLittle) {
  const TestCloud<float> cloud = test::gaussian<float>(100, 1);
  const auto ask = [](const FarQuery&, OctantPoints&) { return false; };
  SphereCertificate certificate;
  for (const DirectionSet set : {DirectionSet::dop6, DirectionSet::dop14, DirectionSet::dop18}) {
    const Supports supports = find_supports(cloud.view(), set, SupportDetail::points, {});
    EXPECT_THROW(smallest_sphere(supports, ask, certificate), std::invalid_argument);
  }
}

TEST(SmallestSphere, IsNoGreaterThanAnyOther) {
  for (const TestCloud<float>& cloud : clouds_for_certificates()) {
    const Sphere smallest = fit(cloud.view(), SphereMethod::exact);
    if (smallest.empty()) continue;
    for (const SphereMethod method : kMethods) {
      for (const SphereGrowth growth : kGrowths) {
        SCOPED_TRACE(cloud.name + ", method " + std::to_string(static_cast<int>(method)));
        const double step = 0x1p-52 * smallest.center().norm();
        EXPECT_LE(smallest.radius(), fit(cloud.view(), {method, growth}).radius() * (1 + 0x1p-46) + step);
      }
    }
  }
}

TEST(SmallestSphere, HasTheSameBitsForEveryExecutionOnLargeClouds) {
  for (const char* shape : {"ball", "surface", "hemisphere"}) {
    const TestCloud<float> cloud = points_of(shape, 150'000);
    SphereCertificate expected_certificate, certificate;
    Sphere expected, sphere;
    test::take(fit_smallest_sphere(cloud.view(), {Serial{}, Isa::scalar}), expected, expected_certificate);
    for (const auto& [name, execution] : test::every_execution()) {
      SCOPED_TRACE(std::string(shape) + ", " + name);
      test::take(fit_smallest_sphere(cloud.view(), execution), sphere, certificate);
      expect_equal(sphere, expected);
      EXPECT_EQ(certificate.support, expected_certificate.support);
      EXPECT_EQ(certificate.weights, expected_certificate.weights);
      EXPECT_EQ(certificate.lower_bound, expected_certificate.lower_bound);
      EXPECT_EQ(certificate.passes, expected_certificate.passes);
    }
  }
}

TEST(SmallestSphere, DoesNotDependOnTheOrderOfAnIndexList) {
  const TestCloud<float> cloud = points_of("ball", 40'000);
  std::vector<std::int32_t> indices(cloud.size());
  std::iota(indices.begin(), indices.end(), 0);
  PointView view = cloud.view();
  const Sphere expected = fit(view, SphereMethod::exact);
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::shuffle(indices.begin(), indices.end(), std::mt19937_64(seed));
    view.indices = indices.data();
    expect_equal(fit(view, SphereMethod::exact), expected);
    expect_equal(fit(view, SphereMethod::ritter), fit(cloud.view(), SphereMethod::ritter));
  }
}

TEST(SmallestSphere, OfCubeCornersACircleAndTwoPointsIsWhatGeometrySays) {
  TestCloud<float> cube{"cube", {}};
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      cube.xyz.push_back((i >> axis & 1) != 0 ? 1.0F : -1.0F);
  }
  EXPECT_NEAR(fit(cube.view(), SphereMethod::exact).radius(), std::sqrt(3.0), 1e-13);
  EXPECT_NEAR(fit(points_of("circle", 500).view(), SphereMethod::exact).radius(), 1, 1e-7);
  const TestCloud<float> two{"two", {-3, 0, 4, 3, 0, -4}};
  EXPECT_NEAR(fit(two.view(), SphereMethod::exact).radius(), 5, 1e-13);
}

// Three points almost on a line and one between them: walking solvers stop for ever here.
TEST(SmallestSphere, EndsOnNearlyCollinearPoints) {
  for (const double e : {1e-2, 1e-6, 1e-9, 1e-13, 1e-16, 1e-18}) {
    const TestCloud<double> cloud{"", {0, 0, 0, 1, e, 0, 0.5, 0, e, 0.25, -e, e}};
    expect_certified(cloud.view());
    const TestCloud<double> thin{"", {0.2, 0.2, 0.8, 0.2 + e, 0.2, 0.8, 0.3, 0.7, 0.8, 0.8, 0.2 - e, 0.8}};
    expect_certified(thin.view());
  }
}

TEST(SmallestSphere, OfAClusterAllocatesNothing) {
  const TestCloud<float> cloud = points_of("ball", 2000);
  std::vector<std::int32_t> indices(300);
  std::iota(indices.begin(), indices.end(), 500);
  const test::Records<float> records(cloud, 32);  // as pcl::PointXYZI
  PointView cluster = records.view();
  cluster.indices = indices.data();
  cluster.count = indices.size();
  Sphere sphere;
  for (const SphereMethod method : {SphereMethod::exact, SphereMethod::epos26, SphereMethod::ritter}) {
    for (const SphereGrowth growth : kGrowths) {
      sphere = *fit_sphere(cluster, {method, growth});  // what is made once is made now
      const std::size_t before = allocations();
      sphere = *fit_sphere(cluster, {method, growth});
      EXPECT_EQ(allocations(), before);
    }
  }
}

TEST(SmallestSphere, OfPointsExactlyOnASphereHoldsThemAll) {
  // Pythagorean quadruples: |p| = 9 exactly.
  TestCloud<float> cloud{"|p| = 9", {}};
  for (const auto& q : {std::array{1, 4, 8}, {4, 4, 7}, {3, 6, 6}, {0, 0, 9}}) {
    std::array<int, 3> p = q;
    std::sort(p.begin(), p.end());
    do {
      for (int signs = 0; signs < 8; ++signs) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          cloud.xyz.push_back(static_cast<float>((signs >> axis & 1) != 0 ? -p[axis] : p[axis]));
      }
    } while (std::next_permutation(p.begin(), p.end()));
  }
  expect_certified(cloud.view());
  const Sphere sphere = fit(cloud.view(), SphereMethod::exact);
  EXPECT_GE(sphere.radius(), 9.0);
  EXPECT_LE(sphere.radius(), 9.0 * (1 + 1e-14));
}

TEST(Growth, DeferredAndSequentialGiveTheSameBitsWithoutAnIndexList) {
  for (const TestCloud<float>& cloud : clouds_for_certificates()) {
    for (const SphereMethod method : kMethods) {
      SCOPED_TRACE(cloud.name + ", method " + std::to_string(static_cast<int>(method)));
      expect_equal(fit(cloud.view(), {method, SphereGrowth::deferred}),
                   fit(cloud.view(), {method, SphereGrowth::sequential}));
    }
  }
}

TEST(Growth, EveryPolicyEnclosesAndHasTheSameBitsForEveryExecution) {
  for (const char* shape : {"ball", "two clusters", "surface"}) {
    const TestCloud<float> cloud = points_of(shape, 130'000);
    for (const SphereMethod method : {SphereMethod::ritter, SphereMethod::epos6}) {
      for (const SphereGrowth growth : kGrowths) {
        const Sphere expected = fit(cloud.view(), {method, growth}, {Serial{}, Isa::scalar});
        EXPECT_EQ(verify(expected, cloud.view()).outside, 0U);
        for (const auto& [name, execution] : test::every_execution()) {
          SCOPED_TRACE(std::string(shape) + ", " + name);
          expect_equal(fit(cloud.view(), {method, growth}, execution), expected);
        }
      }
    }
  }
}

TEST(Growth, OfAnIndexListIsByIndexIfDeferredAndByListIfSequential) {
  const TestCloud<float> cloud = points_of("ball", 3000);
  std::vector<std::int32_t> indices(cloud.size());
  std::iota(indices.rbegin(), indices.rend(), 0);
  PointView backwards = cloud.view();
  backwards.indices = indices.data();
  TestCloud<float> reversed = cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    std::copy_n(&cloud.xyz[3 * i], 3, &reversed.xyz[3 * (cloud.size() - 1 - i)]);
  const SphereOptions deferred(SphereMethod::ritter, SphereGrowth::deferred);
  const SphereOptions sequential(SphereMethod::ritter, SphereGrowth::sequential);
  expect_equal(fit(backwards, deferred), fit(cloud.view(), deferred));
  expect_equal(fit(backwards, sequential), fit(reversed.view(), sequential));
  EXPECT_NE(fit(backwards, sequential).radius(), fit(cloud.view(), sequential).radius());
}

TEST(Growth, OfAFixedCentreIsTheFarthestDistance) {
  const TestCloud<float> cloud = points_of("ball", 5000);
  const Sphere stationary = fit(cloud.view(), {SphereMethod::ritter, SphereGrowth::stationary});
  double farthest = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Coordinates p = load_point(cloud.view(), i);
    farthest = std::max(farthest, (Eigen::Vector3d(p.x, p.y, p.z) - stationary.center()).norm());
  }
  EXPECT_NEAR(stationary.radius(), farthest, 1e-14);
  EXPECT_GT(stationary.radius(), fit(cloud.view(), SphereMethod::ritter).radius());
}

// Shapes harder than the paper's meshes, whose Table 4 has 0.15, 0.9, 8.9 and, for Ritter, 14.5 %.
TEST(Epos, StaysNearTheOptimumOnBumpySurfaces) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    TestCloud<float> cloud{"bumpy", {}};
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const Eigen::Vector3d a(normal(random), normal(random), normal(random));
    for (int i = 0; i < 30'000; ++i) {
      Eigen::Vector3d p(normal(random), normal(random), normal(random));
      p.normalize();
      p *= 1 + 0.3 * std::sin(3 * p.dot(a)) + 0.1 * std::cos(7 * p.x() - 5 * p.y());
      for (int axis = 0; axis < 3; ++axis)
        cloud.xyz.push_back(static_cast<float>(p[axis]));
    }
    const double optimum = fit(cloud.view(), SphereMethod::exact).radius();
    const auto excess = [&](SphereMethod method) { return fit(cloud.view(), method).radius() / optimum - 1; };
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    EXPECT_LE(excess(SphereMethod::epos98), 0.0025);
    EXPECT_LE(excess(SphereMethod::epos26), 0.005);
    EXPECT_LE(excess(SphereMethod::epos14), 0.015);
    EXPECT_LE(excess(SphereMethod::epos6), 0.089);
    EXPECT_LE(excess(SphereMethod::ritter), 0.145);
  }
}

TEST(Epos, OfNoMorePointsThanEndsIsTheSmallestSphere) {
  for (const std::size_t n : {1, 2, 5, 6, 14, 26, 98}) {
    const TestCloud<float> cloud = test::gaussian<float>(n, n);
    const double optimum = fit(cloud.view(), SphereMethod::exact).radius();
    EXPECT_NEAR(fit(cloud.view(), SphereMethod::epos98).radius(), optimum, 1e-13) << n;
    if (n <= 26) {
      EXPECT_NEAR(fit(cloud.view(), SphereMethod::epos26).radius(), optimum, 1e-13) << n;
    }
    if (n <= 6) {
      EXPECT_NEAR(fit(cloud.view(), SphereMethod::epos6).radius(), optimum, 1e-13) << n;
    }
  }
}

// In all places and signs, opposite ones too.
std::vector<Eigen::Vector3d> turns_of(const Eigen::Vector3d& numbers) {
  std::set<std::array<double, 3>> all;
  std::array<double, 3> d = {numbers.x(), numbers.y(), numbers.z()};
  std::sort(d.begin(), d.end());
  do {
    for (int signs = 0; signs < 8; ++signs)
      all.insert({signs & 1 ? -d[0] : d[0], signs & 2 ? -d[1] : d[1], signs & 4 ? -d[2] : d[2]});
  } while (std::next_permutation(d.begin(), d.end()));
  std::vector<Eigen::Vector3d> turns;
  for (const auto& [x, y, z] : all)
    turns.emplace_back(x + 0.0, y + 0.0, z + 0.0);
  return turns;
}

// Points that are farthest along the cube's directions, but that one, and one farther out between these.
TestCloud<double> spiked(const Eigen::Vector3d& spike, const Eigen::Vector3d& left_out) {
  TestCloud<double> cloud{"spiked", {}};
  const auto add = [&](const Eigen::Vector3d& p) { cloud.xyz.insert(cloud.xyz.end(), p.begin(), p.end()); };
  for (const Eigen::Vector3d& numbers :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(1, 1, 1)}) {
    for (const Eigen::Vector3d& d : turns_of(numbers))
      if (!(d.cwiseAbs() == left_out)) add(0.97 * d.normalized());
  }
  add(spike.normalized());
  return cloud;
}

TEST(Epos, OfAsManyPointsAsEndsIsTheSmallestSphereThoughOneIsNoEnd) {
  TestCloud<double> cloud = spiked({0, 1, 2}, {1, 0, 0});
  cloud.xyz.insert(cloud.xyz.end(), 3, 0.0);
  ASSERT_EQ(cloud.size(), 26U);
  const double optimum = fit(cloud.view(), SphereMethod::exact).radius();
  EXPECT_NEAR(fit(cloud.view(), SphereMethod::epos26).radius(), optimum, 1e-13);
  cloud.xyz.insert(cloud.xyz.end(), 3, 0.0);
  EXPECT_GT(fit(cloud.view(), SphereMethod::epos26).radius(), optimum * (1 + 1e-4)) << "the case is too easy";
}

TEST(Epos, With49DirectionsSeesWhatIsFarthestAlongAnyOfThem) {
  for (const Eigen::Vector3d& numbers :
       {Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(1, 1, 2), Eigen::Vector3d(1, 2, 2)}) {
    for (const Eigen::Vector3d& spike : turns_of(numbers)) {
      TestCloud<double> cloud = spiked(spike, {0, 0, 0});
      cloud.xyz.resize(3 * 120, 0.0);
      const double optimum = fit(cloud.view(), SphereMethod::exact).radius();
      EXPECT_NEAR(fit(cloud.view(), SphereMethod::epos98).radius(), optimum, 1e-13) << spike.transpose();
    }
  }
}

TEST(Epos, With49DirectionsStartsNoLooserThanWith13) {
  // A stationary centre shows the first ball: the more extremal points it holds, the less is left outside.
  double sum26 = 0, sum98 = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const TestCloud<float> cloud = points_of("ball", 2000 + seed);
    sum26 += fit(cloud.view(), {SphereMethod::epos26, SphereGrowth::stationary}).radius();
    sum98 += fit(cloud.view(), {SphereMethod::epos98, SphereGrowth::stationary}).radius();
  }
  EXPECT_LT(sum98, sum26);
}

}  // namespace
}  // namespace pcl_bv::detail
