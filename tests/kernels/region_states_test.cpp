// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// States of points: true by exact arithmetic, the same for every instruction set, and seldom unclear.

#include "pcl_bv/kernels/region_states.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clouds.h"
#include "exact.h"

namespace pcl_bv::detail {
namespace {

using States = std::vector<std::uint8_t>;

States states(Isa isa, const PointView& points, const RegionTests& regions) {
  States all(points.count, 9);
  region_states(isa, points, regions, all.data());
  return all;
}

constexpr auto kInside = static_cast<std::uint8_t>(RegionState::inside);
constexpr auto kUnclear = static_cast<std::uint8_t>(RegionState::unclear);

ConvexRegion body(const Coordinates& center, double reach) {
  ConvexRegion region;
  region.center = center;
  region.low = {center.x - reach, center.y - reach, center.z - reach};
  region.high = {center.x + reach, center.y + reach, center.z + reach};
  region.axes = {{{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}}};
  return region;
}

ConvexRegion ball(const Coordinates& center, double radius) {
  ConvexRegion region = body(center, 1.01 * radius);
  region.shape = RegionShape::ball;
  region.radius = radius;
  return region;
}

ConvexRegion slabs(const Coordinates& center, double half) {
  ConvexRegion region = body(center, 2 * half);
  region.shape = RegionShape::slabs;
  region.slab = {half, 0.5 * half, 0.25 * half};
  return region;
}

// A box with round edges, in another unit along an axis.
ConvexRegion round_box(const Coordinates& center, double size) {
  ConvexRegion region = body(center, 2 * size);
  region.shape = RegionShape::rounded;
  region.slab[2] = 0.75 * size;
  region.core = {0.5 * size, 0.25 * size, 0};
  region.weight = {1, 2, 0};
  region.radius = 0.5 * size;
  return region;
}

ConvexRegion planes(const Coordinates& center, double limit) {
  ConvexRegion region;
  region.shape = RegionShape::planes;
  region.center = center;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  region.low = {-infinity, -infinity, -infinity};
  region.high = {infinity, infinity, infinity};
  for (const double sign : {1.0, -1.0}) {
    for (const auto& [x, y, z] : {std::array{0.6, 0.8, 0.0}, {0.0, 0.6, 0.8}, {0.8, 0.0, -0.6}})
      region.planes.push_back({sign * x, sign * y, sign * z, limit});
  }
  return region;
}

ConvexRegion box(const Coordinates& low, const Coordinates& high) {
  ConvexRegion region;
  region.low = low;
  region.high = high;
  return region;
}

// By the definition, in rationals; the axes are of length 1 to 2^-52 only, which its doubt covers.
bool exactly_inside(const ConvexRegion& region, const Coordinates& p) {
  const Coordinates& c = region.center;
  const auto along = [&](const auto& n) { return test::exact_dot(n, p) - test::exact_dot(n, c); };
  for (std::size_t k = 0; k < 3; ++k) {
    if (p[k] < region.low[k] || p[k] > region.high[k]) return false;
  }
  for (const HalfSpace& h : region.planes) {
    if (along(std::array{h.x, h.y, h.z}) > test::Rational(h.limit)) return false;
  }
  test::Rational squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const test::Rational reach = abs(along(region.axes[i]));
    if (region.slab[i] < 1e300 && reach > test::Rational(region.slab[i])) return false;
    const test::Rational beyond = reach - test::Rational(region.core[i]);
    if (beyond > 0) squares += beyond * beyond * test::Rational(region.weight[i] * region.weight[i]);
  }
  return region.radius == 0 || squares <= test::Rational(region.radius) * test::Rational(region.radius);
}

// Points on and near the surfaces of regions about a centre, at a size.
template <typename T>
test::TestCloud<T> near_surfaces(const Coordinates& center, double size) {
  test::TestCloud<T> cloud = test::gaussian<T>(1500, 3, size);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double x = cloud.xyz[3 * i], y = cloud.xyz[3 * i + 1], z = cloud.xyz[3 * i + 2];
    const double norm = i % 3 == 0 ? std::hypot(x, y, z) : i % 3 == 1 ? std::abs(0.6 * x + 0.8 * y) : size;
    const double factor = size / norm * (1 + static_cast<double>(i % 7) * 1e-7);
    for (std::size_t k = 0; k < 3; ++k)
      cloud.xyz[3 * i + k] = static_cast<T>(center[k] + factor * (k == 0 ? x : k == 1 ? y : z));
  }
  return cloud;
}

template <typename T>
void expect_true_states() {
  for (const auto& [place, size] :
       {std::pair{0.0, 1.0}, {5e6, 3.0}, {0.0, 1e-41}, {1e-3, 1e15}, {0.0, 1e30}}) {
    const Coordinates center{place, -place, 0.1 * place};
    const auto cloud = near_surfaces<T>(center, size);
    for (const ConvexRegion& region :
         {ball(center, size), slabs(center, size), round_box(center, size), planes(center, size),
          box({center.x, center.y, center.z - size}, {center.x + size, center.y + size, center.z + size})}) {
      const States all = states(Isa::scalar, cloud.view(), RegionTests({region}));
      int inside = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        inside += all[i] == kInside;
        if (all[i] == kUnclear) continue;
        ASSERT_EQ(all[i] == kInside, exactly_inside(region, load_point(cloud.view(), i)))
            << i << ", at " << place << ", " << size << ", shape " << static_cast<int>(region.shape);
      }
      if (size < 1e18 && size > 1e-18) {
        EXPECT_GT(inside, 20) << place << ", " << size;
      }
    }
  }
}

TEST(RegionStates, OfFloatsAreTrueByExactArithmetic) {
  expect_true_states<float>();
}
TEST(RegionStates, OfDoublesAreTrueByExactArithmetic) {
  expect_true_states<double>();
}

std::vector<ConvexRegion> mixed(double size) {
  return {ball({0.5 * size, 0, 0}, size), slabs({-size, 0.3 * size, 0}, size),
          planes({0, size, -size}, 0.5 * size), box({-size, -size, -size}, {0, 0, 0})};
}

template <typename T>
void expect_the_same() {
  for (const double size : {1.0, 1e-41, 1e20, 1e38}) {
    const RegionTests regions(mixed(size));
    for (const test::TestCloud<T>& cloud : test::nasty_clouds<T>()) {
      const States expected = states(Isa::scalar, cloud.view(), regions);
      const test::Records<T> wide(cloud, 32, 4), padded(cloud, 4 * sizeof(T));
      for (const Isa isa : usable_isas()) {
        SCOPED_TRACE(std::string(isa_name(isa)) + ", " + cloud.name);
        ASSERT_EQ(states(isa, cloud.view(), regions), expected);
        ASSERT_EQ(states(isa, wide.view(), regions), expected);
        ASSERT_EQ(states(isa, padded.view(), regions), expected);
      }
    }
  }
}

TEST(RegionStates, OfFloatsAreTheSameOnEveryInstructionSet) {
  expect_the_same<float>();
}
TEST(RegionStates, OfDoublesAreTheSameOnEveryInstructionSet) {
  expect_the_same<double>();
}

TEST(RegionStates, OfChosenRegionsAreThoseOfTheseAloneOnEveryInstructionSet) {
  const std::vector<ConvexRegion> all = mixed(1);
  const RegionTests regions(all);
  for (const auto& cloud : test::nasty_clouds<float>()) {
    for (const std::vector<std::uint32_t>& places :
         {std::vector<std::uint32_t>{}, {2}, {3, 0}, {1, 2, 3}, {0, 1, 2, 3, 0}}) {
      std::vector<ConvexRegion> some;
      for (const std::uint32_t place : places)
        some.push_back(all[place]);
      const States expected = states(Isa::scalar, cloud.view(), RegionTests(some));
      for (const Isa isa : usable_isas()) {
        States found(cloud.size(), 7);
        region_states(isa, cloud.view(), regions, {places.data(), places.size()}, found.data());
        ASSERT_EQ(found, expected) << isa_name(isa) << ", " << cloud.name << ", " << places.size();
      }
    }
  }
}

TEST(RegionStates, AreSeldomUnclear) {
  for (const double place : {0.0, 5e6}) {
    std::vector<ConvexRegion> regions;
    for (const double step : {0.0, 1.0, 2.0}) {
      const Coordinates center{place + step, place, place};
      // No surface through points of the lattice, 0.5 apart, on which floats are there.
      regions.insert(regions.end(), {ball(center, 0.57), slabs(center, 0.57), round_box(center, 0.57),
                                     planes(center, 0.57)});
    }
    const auto floats = test::gaussian<float>(20'000, 5, 1, place);
    const auto doubles = test::gaussian<double>(20'000, 5, 1, place);
    for (const PointView& points : {floats.view(), doubles.view()}) {
      const States all = states(Isa::automatic, points, RegionTests(regions));
      EXPECT_LT(std::count(all.begin(), all.end(), kUnclear), 10) << place;
      EXPECT_GT(std::count(all.begin(), all.end(), kInside), 1000) << place;
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
