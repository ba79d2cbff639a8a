// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Cylinders, capsules and ellipsoids: what they find. fit_test.cpp holds them to enclosure and to equal bits.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <limits>
#include <set>

#include "box/symmetric_eigen.h"
#include "clouds.h"
#include "directions.h"
#include "exact.h"
#include "executions.h"
#include "fits.h"
#include "pcl_bv/fitting/fit.h"
#include "round/axis_search.h"
#include "round/smallest_ellipsoid.h"

namespace pcl_bv::detail {
namespace {

using test::TestCloud;

constexpr double kPi = 3.14159265358979323846;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
  Eigen::Vector3d direction() {
    // One after another: which argument is evaluated first is the compiler's choice, another one on Arm.
    std::normal_distribution<double> normal;
    const double z = normal(engine_), y = normal(engine_), x = normal(engine_);
    return Eigen::Vector3d(x, y, z).normalized();
  }
  Eigen::Matrix3d rotation() {
    const Eigen::Vector3d a = direction(), b = a.cross(direction()).normalized();
    Eigen::Matrix3d r;
    r << a, b, a.cross(b);
    return r;
  }

 private:
  std::mt19937_64 engine_;
};

// Points of a shape, turned at random and moved.
template <typename T>
TestCloud<T> turned(std::size_t n, std::uint64_t seed, double offset,
                    const std::function<Eigen::Vector3d(Random&)>& point) {
  TestCloud<T> cloud{"turned " + std::to_string(seed), {}};
  Random random(seed);
  const Eigen::Matrix3d rotation = random.rotation();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d p = rotation * point(random) + Eigen::Vector3d::Constant(offset);
    for (int k = 0; k < 3; ++k)
      cloud.xyz.push_back(static_cast<T>(p[k]));
  }
  return cloud;
}

Eigen::Vector3d of_cylinder(Random& random) {
  const double angle = kPi * random.uniform();
  return {std::cos(angle), std::sin(angle), 3 * random.uniform()};
}

Eigen::Vector3d of_capsule(Random& random) {
  const Eigen::Vector3d p = random.direction();
  return p + Eigen::Vector3d(0, 0, p.z() > 0 ? 2 : -2);
}

Eigen::Vector3d of_ellipsoid(Random& random) {
  return Eigen::Vector3d(1, 2, 4).cwiseProduct(random.direction());
}

TEST(Cylinder, OfATurnedCylinderIsNoGreater) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const TestCloud<double> cloud = turned<double>(400, seed, seed % 2 == 0 ? 5e6 : 0, of_cylinder);
    Cylinder cylinder;
    EXPECT_EQ(test::take(fit_cylinder(cloud.view()), cylinder).status, EstimationStatus::ok);
    EXPECT_EQ(verify(cylinder, cloud.view()).outside, 0u);
    EXPECT_LE(cylinder.volume(), 6 * kPi * 1.0001) << "seed " << seed;
    EXPECT_GE(cylinder.volume(), 6 * kPi * 0.95) << "seed " << seed;
    EXPECT_NEAR(cylinder.radius(), 1, 0.02);
  }
}

TEST(Capsule, OfATurnedCapsuleIsNoGreater) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const TestCloud<double> cloud = turned<double>(400, seed, seed % 2 == 0 ? 5e6 : 0, of_capsule);
    Capsule capsule;
    EXPECT_EQ(test::take(fit_capsule(cloud.view()), capsule).status, EstimationStatus::ok);
    EXPECT_EQ(verify(capsule, cloud.view()).outside, 0u);
    EXPECT_LE(capsule.volume(), (4 + 4.0 / 3) * kPi * 1.001) << "seed " << seed;
    EXPECT_GE(capsule.volume(), (4 + 4.0 / 3) * kPi * 0.95) << "seed " << seed;
  }
}

TEST(Capsule, IsNeverGreaterThanTheSmallestSphere) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const TestCloud<float> round =
        turned<float>(300, seed, 0, [](Random& random) { return random.direction(); });
    for (const TestCloud<float>& cloud : {test::gaussian<float>(500, seed), round}) {
      Capsule capsule;
      Sphere sphere;
      capsule = *fit_capsule(cloud.view());
      sphere = *fit_sphere(cloud.view(), SphereMethod::exact);
      EXPECT_LE(capsule.volume(), sphere.volume() * (1 + 1e-12)) << cloud.name;
    }
  }
}

TEST(Ellipsoid, OfATurnedEllipsoidIsNoGreater) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const TestCloud<double> cloud = turned<double>(500, seed, seed % 2 == 0 ? 5e6 : 0, of_ellipsoid);
    Ellipsoid ellipsoid;
    EllipsoidCertificate certificate;
    test::take(fit_smallest_ellipsoid(cloud.view()), ellipsoid, certificate);
    EXPECT_EQ(verify(ellipsoid, cloud.view()).outside, 0u);
    EXPECT_LE(ellipsoid.volume(), 32.0 / 3 * kPi * (1 + 1e-5)) << "seed " << seed;
    EXPECT_GE(ellipsoid.volume(), 32.0 / 3 * kPi * 0.999) << "seed " << seed;
    Eigen::Vector3d radii = ellipsoid.radii();
    std::sort(radii.begin(), radii.end());
    EXPECT_TRUE(radii.isApprox(Eigen::Vector3d(1, 2, 4), 1e-3)) << radii.transpose();
  }
}

// 4 pi / 3 sqrt(27 det S) from the certificate's points and weights, in long double and about the first
// point.
long double bound_of(const PointView& points, const EllipsoidCertificate& certificate) {
  const Coordinates o = load_point(points, certificate.support[0]);
  long double sum = 0, mean[3] = {}, s[3][3] = {};
  for (const double w : certificate.weights)
    sum += w;
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < certificate.support.size(); ++i) {
      const Coordinates p = load_point(points, certificate.support[i]);
      const long double q[3] = {static_cast<long double>(p.x) - o.x, static_cast<long double>(p.y) - o.y,
                                static_cast<long double>(p.z) - o.z};
      const long double w = certificate.weights[i] / sum;
      for (int a = 0; a < 3; ++a) {
        if (pass == 0) mean[a] += w * q[a];
        for (int b = 0; b < 3 && pass == 1; ++b)
          s[a][b] += w * (q[a] - mean[a]) * (q[b] - mean[b]);
      }
    }
  }
  const long double determinant = s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) -
                                  s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
                                  s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
  return 4 * 3.14159265358979323846L / 3 * std::sqrt(27 * determinant);
}

TEST(Ellipsoid, ItsCertificateProvesThatItIsNearlyTheSmallest) {
  std::vector<TestCloud<float>> clouds;
  for (const std::uint64_t seed : {1, 2, 3})
    clouds.push_back(test::gaussian<float>(1000, seed, 3, seed == 3 ? 5e6 : 10));
  clouds.push_back(turned<float>(500, 1, 0, of_cylinder));
  clouds.push_back(turned<float>(500, 2, 0, of_capsule));
  clouds.push_back(turned<float>(500, 3, 0, of_ellipsoid));
  clouds.push_back(test::gaussian<float>(4, 9));
  for (const TestCloud<float>& cloud : clouds) {
    SCOPED_TRACE(cloud.name);
    Ellipsoid ellipsoid;
    EllipsoidCertificate certificate;
    test::take(fit_smallest_ellipsoid(cloud.view()), ellipsoid, certificate);
    for (const double w : certificate.weights)
      EXPECT_GT(w, 0);
    const auto bound = static_cast<double>(bound_of(cloud.view(), certificate));
    EXPECT_NEAR(certificate.lower_bound, bound, 1e-9 * bound);
    EXPECT_LE(certificate.lower_bound, bound);
    EXPECT_LE(ellipsoid.volume(), bound * (1 + 1e-5));
    EXPECT_NEAR(ellipsoid.volume() / bound - 1, certificate.excess, 1e-9);
  }
}

TEST(Ellipsoid, OfOnePointHasItWithWeightOne) {
  const TestCloud<float> cloud{"one", {1, 2, 3}};
  Ellipsoid ellipsoid;
  EllipsoidCertificate certificate;
  test::take(fit_smallest_ellipsoid(cloud.view()), ellipsoid, certificate);
  EXPECT_EQ(certificate.support, std::vector<std::size_t>{0});
  EXPECT_EQ(certificate.weights, std::vector<double>{1});
}

TEST(Ellipsoid, OfTwoHalfSpheresApartIsWithinItsTolerance) {
  for (std::uint64_t seed = 0; seed < (test::kFewCases ? 8 : 40); ++seed) {
    Ellipsoid ellipsoid;
    EllipsoidCertificate certificate;
    test::take(fit_smallest_ellipsoid(turned<float>(500, seed, 0, of_capsule).view()), ellipsoid,
               certificate);
    EXPECT_LE(certificate.excess, 2.1e-6) << "seed " << seed;
  }
}

// Rounding errors moved all weight between the second and the fourth point until only one point had weight.
TEST(Ellipsoid, OfPointsOfWhichTwoAreNearlyTheSameHoldsThemAll) {
  const TestCloud<double> cloud{
      "nearly the same",
      {-2.0078112455608884e+66, -2.0899708802448861e+66, 1.7197589334108743e+66,   //
       -1.4547860466473922e+66, -2.9375839536478531e+66, -7.8169888120014725e+65,  //
       -9.3323945785267641e+65, -1.2667158010706443e+66, 2.9801594354570456e+66,   //
       -1.4547860466473922e+66, -2.9375839536478527e+66, -7.8169888120014716e+65,  //
       -2.4065231727163372e+66, 2.2063778439805914e+66,  8.3510364380100057e+65}};
  const Fitted<Ellipsoid> ellipsoid = fit_ellipsoid(cloud.view());
  EXPECT_EQ(verify(*ellipsoid, cloud.view()).outside, 0U);
  EXPECT_GT(ellipsoid->radii().minCoeff(), 1e65);
}

TEST(Ellipsoid, OfACubeIsItsSphere) {
  const TestCloud<float> cloud{
      "cube", {1, 1, 1, -1, 1, 1, 1, -1, 1, -1, -1, 1, 1, 1, -1, -1, 1, -1, 1, -1, -1, -1, -1, -1}};
  Ellipsoid ellipsoid = *fit_ellipsoid(cloud.view());
  EXPECT_TRUE(ellipsoid.radii().isApprox(Eigen::Vector3d::Constant(std::sqrt(3.0)), 1e-6));
  EXPECT_NEAR(ellipsoid.center().norm(), 0, 1e-6);
}

TEST(SmallestEllipsoid, OfASimplexWeighsItsCornersEqually) {
  const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 1, 1}, {0.3, 0.5, 0.2}};
  for (const int dimensions : {3, 2}) {
    const std::size_t used = dimensions == 3 ? 4 : 3;
    std::vector<Eigen::Vector3d> points(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(used));
    points.emplace_back(0.3, 0.5, 0.2);
    const WeightedEllipsoid found = smallest_ellipsoid(points, dimensions, 1e-9, 1000);
    for (std::size_t i = 0; i < used; ++i)
      EXPECT_NEAR(found.weights[i], 1.0 / static_cast<double>(used), 1e-6);
  }
}

TEST(SymmetricEigen, DecomposesAndSorts) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d r = random.rotation();
    const Eigen::Vector3d values(random.uniform(), i % 3 == 0 ? 0 : 1e-9 * random.uniform(),
                                 random.uniform());
    const Eigen::Matrix3d m = r * values.asDiagonal() * r.transpose();
    const SymmetricEigen found = symmetric_eigen((m + m.transpose()) / 2);
    EXPECT_TRUE((found.vectors * found.values.asDiagonal() * found.vectors.transpose()).isApprox(m, 1e-14));
    EXPECT_TRUE((found.vectors.transpose() * found.vectors).isIdentity(1e-15));
    EXPECT_GE(found.values[0], found.values[1]);
    EXPECT_GE(found.values[1], found.values[2]);
  }
}

// All fits on degenerate input, and with bad points first.
template <typename T>
void expect_flat_results() {
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const auto of_rank = [&](int rank, T x, T y) {
    return rank == 0   ? std::array<T, 3>{T(0.5), T(-0.25), T(3)}
           : rank == 1 ? std::array<T, 3>{x, 2 * x, -x}
                       : std::array<T, 3>{x, y, x + 2 * y};
  };
  for (const int rank : {0, 1, 2}) {
    TestCloud<T> cloud{"flat", {nan, 0, 0}};
    for (int i = 0; i < 60; ++i) {
      const std::array<T, 3> p = of_rank(rank, static_cast<T>(i % 8), static_cast<T>(i / 8));
      cloud.xyz.insert(cloud.xyz.end(), p.begin(), p.end());
    }
    SCOPED_TRACE(rank);
    Cylinder cylinder;
    Capsule capsule;
    Ellipsoid ellipsoid;
    EllipsoidCertificate certificate;
    for (const EstimationResult& result :
         {test::take(fit_cylinder(cloud.view()), cylinder), test::take(fit_capsule(cloud.view()), capsule),
          test::take(fit_smallest_ellipsoid(cloud.view()), ellipsoid, certificate)}) {
      EXPECT_EQ(result.status, EstimationStatus::degenerate);
      EXPECT_EQ(result.rank, rank);
      EXPECT_EQ(result.dropped, 1u);
      EXPECT_EQ(result.used, 60u);
    }
    EXPECT_NEAR(cylinder.volume(), 0, 1e-9);
    EXPECT_NEAR(ellipsoid.volume(), 0, 1e-4);
    EXPECT_LE(certificate.excess, 1e-5);
    EXPECT_EQ(certificate.lower_bound, 0);
    if (rank < 2) {
      EXPECT_NEAR(capsule.volume(), 0, 1e-12);
    }
    if (rank == 0) {
      EXPECT_EQ(cylinder.radius(), 0);
      EXPECT_EQ(cylinder.half_height(), 0);
      EXPECT_EQ(capsule.radius(), 0);
      EXPECT_EQ(ellipsoid.radii(), Eigen::Vector3d::Zero());
      EXPECT_EQ(ellipsoid.center(), Eigen::Vector3d(0.5, -0.25, 3));
    }
    if (rank == 1) {
      EXPECT_NEAR((capsule.b() - capsule.a()).norm(), 7 * std::sqrt(6.0), 1e-12);
      EXPECT_NEAR(ellipsoid.radii()[0], 3.5 * std::sqrt(6.0), 1e-6);
    }
  }
}

TEST(RoundFits, OfFlatFloatPointsAreFlat) {
  expect_flat_results<float>();
}
TEST(RoundFits, OfFlatDoublePointsAreFlat) {
  expect_flat_results<double>();
}

TEST(AxisSearch, LooksAtAllOfFewVertices) {
  LocalHull hull;
  for (int i = 0; i < 3; ++i)
    hull.vertices.push_back({{}, Eigen::Vector3d::Unit(i), 0});
  EXPECT_EQ(search_vertices(hull),
            (std::vector<Eigen::Vector3d>{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                          Eigen::Vector3d::UnitZ()}));
}

TEST(AxisSearch, LooksAtThoseOfManyPointsThatReachFarthestAlongEachOf49Directions) {
  Random random(12);
  std::vector<Eigen::Vector3d> points(2000);
  for (Eigen::Vector3d& p : points)
    p = random.direction();
  LocalHull hull;
  for (const Eigen::Vector3d& p : points)
    hull.vertices.push_back({{}, p, 0});
  std::set<std::size_t> farthest;
  for (const auto& [x, y, z] : test::integer_directions()) {
    const Eigen::Vector3d d(x, y, z);
    const auto less = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.dot(d) < b.dot(d); };
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), less);
    farthest.insert(
        {static_cast<std::size_t>(low - points.begin()), static_cast<std::size_t>(high - points.begin())});
  }
  std::vector<Eigen::Vector3d> expected;
  for (const std::size_t i : farthest)
    expected.push_back(points[i]);
  EXPECT_EQ(search_vertices(hull), expected) << "seed 12";
}

TEST(RoundFits, OfNothingAreEmpty) {
  Cylinder cylinder({0, 0, 0}, {0, 0, 1}, 1, 1);
  Capsule capsule({0, 0, 0}, {0, 0, 1}, 1);
  Ellipsoid ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {1, 1, 1});
  EXPECT_EQ(test::take(fit_cylinder(PointView()), cylinder).status, EstimationStatus::no_valid_points);
  EXPECT_EQ(test::take(fit_capsule(PointView()), capsule).status, EstimationStatus::no_valid_points);
  EXPECT_EQ(test::take(fit_ellipsoid(PointView()), ellipsoid).status, EstimationStatus::no_valid_points);
  EXPECT_TRUE(cylinder.empty() && capsule.empty() && ellipsoid.empty());
}

// Without the one vertex off the plane the ellipsoid's matrix would be singular.
TEST(RoundFits, OfAPlaneWithOnePointOffItNeverThrow) {
  for (const double off : {1e-9, 0x1p-34, -0x1p-34, 0x1p-33}) {
    SCOPED_TRACE(off);
    TestCloud<double> cloud{"grid", {0.3, 3, off}};
    for (int i = 0; i < 3600; ++i)
      cloud.xyz.insert(cloud.xyz.end(), {0.1 * (i % 60), 0.1 * (i / 60), 0.0});
    Cylinder cylinder;
    Capsule capsule;
    Ellipsoid ellipsoid;
    EXPECT_NE(test::take(fit_cylinder(cloud.view()), cylinder).status, EstimationStatus::failed);
    EXPECT_NE(test::take(fit_capsule(cloud.view()), capsule).status, EstimationStatus::failed);
    EXPECT_NE(test::take(fit_ellipsoid(cloud.view()), ellipsoid).status, EstimationStatus::failed);
    for (const AnyVolume& volume : {AnyVolume(cylinder), AnyVolume(capsule), AnyVolume(ellipsoid)})
      EXPECT_EQ(verify(volume, cloud.view()).outside, 0u) << shape_name(volume);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
