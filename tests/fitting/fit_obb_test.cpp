// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Claims about which boxes the methods find.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "box/obb_axes.h"
#include "obbs.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv::detail {
namespace {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(Obb, OfATurnedBoxIsThatBox) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 40; ++i) {
    const Matrix3d turn = random_turn(random);
    const Vector3d half(3, 2, 1), center(10, -20, 5);
    const auto cloud = box_cloud<double>(half, turn, center, 400, static_cast<std::uint64_t>(i));
    const Obb box = fit(cloud, ObbMethod::minimal);
    EXPECT_LT(misalignment(box, turn), 1e-12) << i;
    EXPECT_TRUE(box.half_extents().isApprox(half, 1e-12)) << box.half_extents().transpose();
    EXPECT_TRUE(box.center().isApprox(center, 1e-13));
    EXPECT_LT(fit(cloud, ObbMethod::dito14).volume(), 48 * 1.6);
  }
}

TEST(Obb, OfEightCornersIsFoundByDito14) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 40; ++i) {
    const Matrix3d turn = random_turn(random);
    const auto cloud = box_cloud<double>({5, 2, 1}, turn, {1, 2, 3}, 8, 0);
    EXPECT_NEAR(fit(cloud, ObbMethod::dito14).volume(), 80, 1e-10) << i;
  }
}

TEST(Obb, Dito14OfARodIsAlongItThoughOtherDirectionsSeeLittleOfIt) {
  // Across (1, -1, -1), whose ends are then any points; the farthest pair is seen by other directions.
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 50; ++i) {
    const Vector3d along = Vector3d(1, -1, -1).cross(Vector3d(unit(random), unit(random), unit(random)));
    const Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), along).toRotationMatrix();
    TestCloud<double> cloud{"rod", {}};
    for (int k = 0; k < 300; ++k) {
      const Vector3d p = turn * Vector3d(10 * unit(random), 0.5 * unit(random), 0.3 * unit(random));
      cloud.xyz.insert(cloud.xyz.end(), p.begin(), p.end());
    }
    const Obb box = fit(cloud, ObbMethod::dito14);
    EXPECT_LT(box.axes().col(0).cross(along.normalized()).norm(), 0.1) << "seed 9, " << i;
  }
}

// Half the area of the least of the three boxes on the edges of DiTO's base triangle: the two extreme points
// of a direction that are farthest apart, and the point farthest from their line.
double least_half_area_on_base_triangle(const std::vector<Vector3d>& points) {
  const auto farthest = [&](const auto& measure) {
    return *std::max_element(points.begin(), points.end(),
                             [&](const Vector3d& a, const Vector3d& b) { return measure(a) < measure(b); });
  };
  Vector3d p0 = points[0], p1 = p0;
  for (const Vector3d& d : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(1, 1, 1),
                            Vector3d(1, 1, -1), Vector3d(1, -1, 1), Vector3d(1, -1, -1)}) {
    const Vector3d low = farthest([&](const Vector3d& p) { return -p.dot(d); });
    const Vector3d high = farthest([&](const Vector3d& p) { return p.dot(d); });
    if ((high - low).norm() > (p1 - p0).norm()) p0 = low, p1 = high;
  }
  const Vector3d p2 = farthest([&](const Vector3d& p) { return (p - p0).cross(p1 - p0).norm(); });
  const Vector3d normal = (p1 - p0).cross(p2 - p0).normalized();
  const auto extent = [&](const Vector3d& d) {
    return farthest([&](const Vector3d& p) { return p.dot(d); }).dot(d) +
           farthest([&](const Vector3d& p) { return -p.dot(d); }).dot(-d);
  };
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& edge : {Vector3d(p1 - p0), Vector3d(p2 - p1), Vector3d(p0 - p2)}) {
    const Vector3d e = edge.normalized();
    const double x = extent(e), y = extent(normal), z = extent(e.cross(normal));
    least = std::min(least, x * y + y * z + z * x);
  }
  return least;
}

TEST(Obb, Dito14IsNoGreaterThanTheBoxesOnItsBaseTriangle) {
  // As many points as all of them take part in each step.
  std::mt19937_64 random(10);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Matrix3d turn = random_turn(random);
    TestCloud<double> cloud{"", {}};
    std::vector<Vector3d> points;
    for (int k = 0; k < 14; ++k) {
      const double x = normal(random), y = normal(random), z = normal(random);
      points.emplace_back(turn * Vector3d(3 * x, y, 0.5 * z));
      cloud.xyz.insert(cloud.xyz.end(), points.back().begin(), points.back().end());
    }
    EXPECT_LT(fit(cloud, ObbMethod::dito14).surface_area() / 2,
              least_half_area_on_base_triangle(points) * (1 + 1e-5))
        << "seed 10, " << i;
  }
}

TEST(FewPoints, AreAllOfNoMoreThanThereAreEndsAndOfMoreTheEnds) {
  const FloatEnvironment environment;
  for (const DirectionSet set : {DirectionSet::dop14, DirectionSet::dop26}) {
    const std::size_t ends = 2 * direction_count(set);
    for (const std::size_t n : {std::size_t{1}, ends, ends + 1, 2 * ends}) {
      const auto cloud = gaussian<double>(n, n);
      const Supports supports = find_supports(cloud.view(), set, SupportDetail::points, {});
      const LocalFrame frame(supports);
      const FewPoints few = support_or_all_points(cloud.view(), supports, frame);
      ASSERT_EQ(few.size(), std::min(n, ends));
      for (std::size_t k = 0; k < n && n <= ends; ++k)
        EXPECT_EQ(few[k], frame.local(load_point(cloud.view(), k)));
      for (std::size_t k = 0; k < ends && n > ends; ++k) {
        const Support& along = supports.along[k / 2];
        EXPECT_EQ(few[k], frame.local((k % 2 == 0 ? along.low_point : along.high_point).point));
      }
    }
  }
}

TEST(Obb, OfAGaussianCloudHasThePrincipalAxes) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const Matrix3d turn = random_turn(random);
  TestCloud<float> cloud{"gauss", {}};
  for (int i = 0; i < 100'000; ++i) {
    const Vector3d p = turn * Vector3d(5 * normal(random), 2 * normal(random), normal(random));
    for (const double c : p)
      cloud.xyz.push_back(static_cast<float>(c));
  }
  EXPECT_LT(misalignment(fit(cloud, ObbMethod::pca), turn), 0.01);
}

TEST(Obb, UprightMethodsFindTheYawOfATurnedBoxForAnyUp) {
  for (const ObbMethod method : kUpright) {
    for (const double angle : {0.0, 0.1, 0.7, 1.2, -0.4, 2.9}) {
      const auto cloud = box_cloud<double>({4, 1.5, 1}, yaw_turn(angle), {100, -50, 3}, 2000, 7);
      const double tolerance = method == ObbMethod::yaw ? 1e-12 : 0.02;
      EXPECT_LT(misalignment(fit(cloud, method), yaw_turn(angle)), tolerance) << angle;
      for (const Vector3d& up :
           {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(0, 5e-20, 0), Vector3d(1, 2, 3)}) {
        const Matrix3d lift = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up).toRotationMatrix();
        const auto lifted = box_cloud<double>({4, 1.5, 1}, lift * yaw_turn(angle), {10, -5, 3}, 2000, 7);
        const Obb box = fit(lifted, ObbOptions(method, up));
        EXPECT_LT(misalignment(box, lift * yaw_turn(angle)), tolerance + 1e-11)
            << angle << ", up " << up.transpose();
        EXPECT_NEAR((box.axes().transpose() * up.normalized()).cwiseAbs().maxCoeff(), 1, 1e-15)
            << "not upright";
      }
    }
  }
}

TEST(Obb, AboutAnAxisOfTheFrameIsExactlyUpright) {
  const TestCloud<float> cloud = test::gaussian<float>(1000, 4);
  for (const ObbMethod method : kUpright) {
    for (int k = 0; k < 3; ++k) {
      const Obb box = fit(cloud, ObbOptions(method, -Vector3d::Unit(k)));
      int along = 0;
      for (int i = 0; i < 3; ++i)
        along += box.axis(i).cwiseAbs() == Vector3d::Unit(k);
      EXPECT_EQ(along, 1);
    }
  }
}

// Two sides of a car as a LiDAR sees them: the least area may turn it by what its one far corner allows.
TEST(Obb, LShapeFindsTheSidesOfAnLThatTheLeastAreaMisses) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> uniform(0, 1);
  int yaw_misses = 0;
  for (int i = 0; i < 30; ++i) {
    const double angle = 1.5 * uniform(random);
    TestCloud<float> cloud{"L", {}};
    for (int n = 0; n < 600; ++n) {
      const bool long_side = n % 3 != 0;
      const Vector3d p = yaw_turn(angle) * Vector3d(long_side ? 4.2 * uniform(random) : noise(random),
                                                    long_side ? noise(random) : 1.7 * uniform(random),
                                                    1.4 * uniform(random));
      for (const double c : Vector3d(p + Vector3d(20, 10, 0)))
        cloud.xyz.push_back(static_cast<float>(c));
    }
    EXPECT_LT(misalignment(fit(cloud, ObbMethod::lshape), yaw_turn(angle)), 0.03) << "angle " << angle;
    yaw_misses += misalignment(fit(cloud, ObbMethod::yaw), yaw_turn(angle)) > 0.1;
  }
  EXPECT_GT(yaw_misses, 10) << "the cases are too easy";
}

TEST(Obb, LShapeFindsTheSidesOfAnLOfSevenPointsInAnyCornerOfTheBox) {
  for (int corner = 0; corner < 4; ++corner) {
    const Matrix3d turn = yaw_turn(0.3 + corner * 1.5707963267948966);
    TestCloud<double> cloud{"seven points", {}};
    for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(1.5, 0, 0), Vector3d(3, 0, 0), Vector3d(4, 0, 1),
                              Vector3d(0, 1, 0), Vector3d(0, 1.5, 0), Vector3d(0, 2, 0)}) {
      for (const double c : Vector3d(turn * p))
        cloud.xyz.push_back(c);
    }
    EXPECT_LT(misalignment(fit(cloud, ObbMethod::lshape), turn), 0.05) << corner;
  }
}

TEST(Obb, MinimalIsNoGreaterThanTheOthers) {
  constexpr double rounding = 1 + 1e-9;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    for (const std::size_t n : {4, 5, 10, 30, 300, 20'000}) {
      TestCloud<float> cloud = test::gaussian<float>(n, seed);
      for (std::size_t i = 0; i < cloud.size(); ++i)
        cloud.xyz[3 * i + seed % 3] = 3 * cloud.xyz[3 * i + seed % 3] + cloud.xyz[3 * i + (seed + 1) % 3];
      const double least = fit(cloud, ObbMethod::minimal).volume();
      for (const ObbMethod method : kMethods)
        EXPECT_LE(least, fit(cloud, method).volume() * rounding) << static_cast<int>(method) << ", n " << n;
      Aabb upright = *fit_aabb(cloud.view());
      EXPECT_LE(least, upright.volume() * rounding);
      EXPECT_LE(fit(cloud, ObbMethod::dito14).surface_area(), upright.surface_area() * rounding);
      EXPECT_LE(fit(cloud, ObbMethod::yaw).volume(), fit(cloud, ObbMethod::lshape).volume() * rounding);
    }
  }
}

// A box of 6 x 4 x 2 whose faces bulge, so that all its 2 400 points are vertices of the hull.
TestCloud<double> pillow(const Matrix3d& turn) {
  TestCloud<double> cloud{"pillow", {}};
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < 400; ++i) {
      Vector3d p;
      const double u = (i % 20 - 9.5) / 10, v = (i / 20 - 9.5) / 10;
      p[face / 2] = (face % 2 == 0 ? 1 : -1) * (1 - 0.01 * (u * u + v * v));
      p[(face / 2 + 1) % 3] = u;
      p[(face / 2 + 2) % 3] = v;
      for (const double c : Vector3d(turn * p.cwiseProduct(Vector3d(3, 2, 1))))
        cloud.xyz.push_back(c);
    }
  }
  return cloud;
}

TEST(Obb, MinimalOfManyVerticesIsTheBoxTheyWereMadeIn) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 10; ++i)
    EXPECT_LE(fit(pillow(random_turn(random)), ObbMethod::minimal).volume(), 48 * (1 + 1e-6))
        << "seed 7, " << i;
}

// A regular tetrahedron's smallest box is the cube around it: a third of which it fills.
TEST(Obb, MinimalOfATetrahedronIsItsCube) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d turn = random_turn(random);
    TestCloud<double> cloud{"tetrahedron", {}};
    for (const Vector3d& p :
         {Vector3d(1, 1, 1), Vector3d(1, -1, -1), Vector3d(-1, 1, -1), Vector3d(-1, -1, 1)})
      for (const double c : Vector3d(turn * p))
        cloud.xyz.push_back(c);
    EXPECT_NEAR(fit(cloud, ObbMethod::minimal).volume(), 8, 1e-7) << i;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
