// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Every shape against its formula: where its points are, and how they are spread.
#include "pcl_bv/synth/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pcl_bv/synth/synth.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t points = 200'000;
constexpr std::uint64_t seed = 3;

double offset(const SynthCloud& cloud, std::size_t point, std::size_t axis) {
  return cloud.xyz[3 * point + axis] - shape_center[axis];
}

double distance(const SynthCloud& cloud, std::size_t point) {
  return std::hypot(offset(cloud, point, 0), offset(cloud, point, 1), offset(cloud, point, 2));
}

struct Moments {
  double mean = 0, variance = 0, fourth = 0;
};

Moments moments_of(const SynthCloud& cloud, std::size_t axis) {
  Moments m;
  const auto n = static_cast<double>(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    m.mean += offset(cloud, i, axis) / n;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double d = offset(cloud, i, axis) - m.mean;
    m.variance += d * d / n;
    m.fourth += d * d * d * d / n;
  }
  return m;
}

TEST(Shapes, SpherePointsLieOnTheUnitSphere) {
  const SynthCloud cloud = make_sphere(points, seed);
  // Coordinates up to 4 are rounded to 2.4e-7 each.
  for (std::size_t i = 0; i < points; ++i)
    ASSERT_NEAR(distance(cloud, i), 1, 5e-7) << "point " << i;
}

TEST(Shapes, SphereIsEvenlyCovered) {
  const SynthCloud cloud = make_sphere(points, seed);
  // Each coordinate of a uniform point on the sphere is uniform in [-1, 1] (Archimedes).
  for (std::size_t axis = 0; axis < 3; ++axis) {
    SCOPED_TRACE(axis);
    const Moments m = moments_of(cloud, axis);
    EXPECT_NEAR(m.mean, 0, 5 * std::sqrt(1.0 / 3 / points));
    EXPECT_NEAR(m.variance, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / points));
    EXPECT_NEAR(m.fourth, 1.0 / 5, 5 * std::sqrt(16.0 / 225 / points));
  }
}

TEST(Shapes, BoxPointsFillTheBoxEvenly) {
  const SynthCloud cloud = make_box(points, seed);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    SCOPED_TRACE(axis);
    const double half = box_half_extents[axis];
    double widest = 0;
    for (std::size_t i = 0; i < points; ++i)
      widest = std::max(widest, std::abs(offset(cloud, i, axis)));
    EXPECT_LE(widest, half);
    EXPECT_GT(widest, half * (1 - 1e-3));
    const Moments m = moments_of(cloud, axis);
    EXPECT_NEAR(m.mean, 0, 5 * half * std::sqrt(1.0 / 3 / points));
    EXPECT_NEAR(m.variance / (half * half), 1.0 / 3, 5 * std::sqrt(4.0 / 45 / points));
  }
}

TEST(Shapes, GaussHasTheMomentsOfTheNormalDistribution) {
  const SynthCloud cloud = make_gauss(points, seed);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    SCOPED_TRACE(axis);
    const Moments m = moments_of(cloud, axis);
    EXPECT_NEAR(m.mean, 0, 5 * std::sqrt(1.0 / points));
    EXPECT_NEAR(m.variance, 1, 5 * std::sqrt(2.0 / points));
    EXPECT_NEAR(m.fourth, 3, 5 * std::sqrt(96.0 / points));
  }
}

TEST(Shapes, GaussCoordinatesAreUncorrelated) {
  const SynthCloud cloud = make_gauss(points, seed);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double product = 0;
    for (std::size_t i = 0; i < points; ++i) {
      product += offset(cloud, i, axis) * offset(cloud, i, (axis + 1) % 3) / points;
    }
    EXPECT_NEAR(product, 0, 5 * std::sqrt(1.0 / points)) << "axes " << axis << " and the next";
  }
}

/// The documented formula, written a second time.
double expected_radius(double x, double y, double z, double shape) {
  return 1 + 0.16 * std::sin(3 * x + shape) + 0.12 * std::sin(4 * y + 2 * shape) +
         0.08 * std::sin(6 * z + 3 * shape);
}

void expect_on_bumpy_surface(const SynthCloud& cloud, double shape) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double r = distance(cloud, i);
    const double expected =
        expected_radius(offset(cloud, i, 0) / r, offset(cloud, i, 1) / r, offset(cloud, i, 2) / r, shape);
    ASSERT_NEAR(r, expected, 2e-6) << "point " << i;
  }
}

TEST(Shapes, SurfacePointsLieOnTheBumpySurface) {
  expect_on_bumpy_surface(make_surface(points, seed), 0);
  expect_on_bumpy_surface(make_surface(points, seed, 2.5), 2.5);
}

TEST(Shapes, SurfaceIsClosed) {
  const SynthCloud cloud = make_surface(points, seed);
  // Every octant is reached, by about an eighth of the directions.
  std::array<std::size_t, 8> octants{};
  for (std::size_t i = 0; i < points; ++i) {
    ++octants[(offset(cloud, i, 0) > 0) + 2 * (offset(cloud, i, 1) > 0) + 4 * (offset(cloud, i, 2) > 0)];
  }
  for (const std::size_t count : octants)
    EXPECT_NEAR(static_cast<double>(count), points / 8.0, 5 * std::sqrt(points * (7 / 64.0)));
}

TEST(Shapes, PaperScenesAreBumpySurfacesOfThePapersSizes) {
  for (const std::size_t n : {4010u, 7260u, 30892u, 32875u, 48485u, 100722u, 327323u}) {
    SCOPED_TRACE(n);
    const SynthCloud cloud = make_synth(parse_synth("paper-" + std::to_string(n)));
    EXPECT_EQ(cloud.size(), n);
    expect_on_bumpy_surface(cloud, static_cast<double>(n));
  }
}

TEST(Shapes, SameSeedGivesSameBitsAndAnotherSeedOthers) {
  for (const std::string name : {"sphere", "box", "gauss", "surface"}) {
    SCOPED_TRACE(name);
    const auto a = make_synth(parse_synth(name + ":1000:5")).xyz;
    EXPECT_EQ(a, make_synth(parse_synth(name + ":1000:5")).xyz);
    EXPECT_NE(a, make_synth(parse_synth(name + ":1000:6")).xyz);
  }
}

TEST(Shapes, FewerPointsAreTheFirstOfMore) {
  const auto few = make_gauss(10, seed).xyz;
  const auto many = make_gauss(20, seed).xyz;
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
}

}  // namespace
}  // namespace pcl_bv::detail
