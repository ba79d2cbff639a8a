// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The sensor of the street: beams, ranges, noise, what gives no return, and the nearest surface winning.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "street_fixture.h"

namespace pcl_bv::detail {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(StreetBeam, ElevationsFallFromTwoToMinusTwentyFourPointEightDegrees) {
  double previous = 90;
  for (double beam = 0; beam < street_beams; beam += 0.5) {
    const double elevation = std::asin(street_beam(beam, 5, 2000)[2]) / degree;
    EXPECT_LT(elevation, previous);
    previous = elevation;
  }
  EXPECT_NEAR(std::asin(street_beam(0, 5, 2000)[2]) / degree, 2, 1e-9);
  EXPECT_NEAR(std::asin(street_beam(63, 5, 2000)[2]) / degree, -24.8, 1e-9);
}

TEST(StreetBeam, ColumnsTurnClockwiseFromBackwardOverForward) {
  const Vector back = street_beam(0, 0, 2000);
  EXPECT_LT(back[0], -0.99);
  EXPECT_GT(back[1], 0);
  EXPECT_GT(street_beam(0, 500, 2000)[1], 0.99);  // left
  EXPECT_GT(street_beam(0, 1000, 2000)[0], 0.99);
  EXPECT_LT(street_beam(0, 1500, 2000)[1], -0.99);
  for (std::size_t column = 0; column < 2000; ++column) {
    const Vector d = street_beam(20, column, 2000);
    ASSERT_NEAR(dot(d, d), 1, 1e-14);
  }
}

TEST(Street, OfTwiceAsManyBeamsHasThoseOfTheStreetAndOnesBetweenThem) {
  StreetOptions options;
  options.points = 250'000;
  options.beams = 128;
  const SynthCloud cloud = make_street_frame(options, 3).cloud;
  ASSERT_EQ(cloud.height, 128U);
  const std::size_t columns = cloud.xyz.size() / 3 / 128;
  EXPECT_EQ(columns, 1953U);
  for (std::size_t i = 0; i < cloud.xyz.size() / 3; ++i) {
    const Vector p{cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]};
    const Vector ray = street_beam(0.5 * static_cast<double>(i / columns), i % columns, columns);
    const double length = std::sqrt(dot(p, p));
    ASSERT_NEAR(dot(p, ray), length, 1e-6 * length) << i;
  }
}

TEST(Street, EveryReturnLiesOnItsBeam) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const SynthCloud& cloud = street_sweep(seed).cloud;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vector p = point_of(cloud, i);
      const Vector d = beam_of(cloud, i);
      const double range = range_of(cloud, i);
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(p[axis], range * d[axis], 1e-5) << "ray " << i;
    }
  }
}

TEST(Street, ReturnsComeFromWithinRange) {
  const SynthCloud& cloud = street_sweep(1).cloud;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!is_return(cloud, i)) continue;
    ASSERT_GT(range_of(cloud, i), 2);
    // A false return is up to 1.6 times as far as the ground that it was reflected by.
    ASSERT_LT(range_of(cloud, i), (is_false_return(cloud, i) ? 1.6 : 1.0) * street_max_range + noise_bound);
  }
}

TEST(Street, EveryRayIsOneOfGroundObjectFalseOrNone) {
  const SynthCloud& cloud = street_sweep(1).cloud;
  ASSERT_EQ(cloud.size(), 128'000u);
  ASSERT_EQ(cloud.object.size(), cloud.size());
  ASSERT_EQ(cloud.ground.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_LE(cloud.ground[i], 1u);
    const bool on_object = cloud.object[i] != 0;
    const bool on_ground = cloud.ground[i] != 0;
    ASSERT_FALSE(on_object && on_ground);
    ASSERT_TRUE(is_return(cloud, i) || !(on_object || on_ground));
  }
}

TEST(Street, RaysWithoutReturnAreDroppedAtTheirRate) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const SynthCloud& cloud = street_sweep(seed).cloud;
    std::size_t none = 0;
    std::size_t steep = 0;
    std::size_t steep_none = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      none += !is_return(cloud, i);
      // Downward by more than 20 degrees a ray meets something within 6 m, and no car window is that low.
      if (beam_of(cloud, i)[2] > -std::sin(20 * degree)) continue;
      ++steep;
      steep_none += !is_return(cloud, i);
    }
    const double share = static_cast<double>(none) / static_cast<double>(cloud.size());
    EXPECT_GT(share, 0.02);
    EXPECT_LT(share, 0.2);
    const auto n = static_cast<double>(steep);
    EXPECT_NEAR(static_cast<double>(steep_none) / n, 0.015, 5 * std::sqrt(0.015 / n));
  }
}

/// Where the ray enters a box given in the axes of an object; infinity if it misses.
double enter_box(const StreetObject& object, const Vector& direction, const Vector& low, const Vector& high) {
  const Vector origin = from_center(object, {0, 0, 0});
  const Vector d = in_axes(object, direction);
  double enter = 0;
  double exit = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - origin[axis]) / d[axis];
    const double b = (high[axis] - origin[axis]) / d[axis];
    enter = std::max(enter, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  return enter < exit ? enter : std::numeric_limits<double>::infinity();
}

/// A box inside the solid of a house, wall or car, whatever its shape: nothing behind it may be seen.
double enter_core(const StreetObject& object, const Vector& direction) {
  const auto [x, y, z] = object.half_extents;
  switch (object.kind) {
    case SynthObjectKind::house:  // behind the bay (0.6 m) and the windows (0.3 m), below the roof (2.5 m)
      return enter_box(object, direction, {-x, -y, -z}, {x, y - 0.95, z - 2.55});
    case SynthObjectKind::wall:
      return enter_box(object, direction, {-x, -y, -z}, {x, y, z});
    case SynthObjectKind::car:  // between wheel arches and below the hood
      return enter_box(object, direction, {-0.8 * x, -0.6 * y, 0.3 - z}, {0.8 * x, 0.6 * y, 0.8 - z});
    default:
      return std::numeric_limits<double>::infinity();
  }
}

/// Whether a ray enters the upper part of a car's cabin, glass all around, and meets no other car on its way.
bool enters_cabin(const std::vector<StreetObject>& objects, const StreetObject& car,
                  const Vector& direction) {
  const auto [x, y, z] = car.half_extents;
  if (!std::isfinite(
          enter_box(car, direction, {-0.35 * x, -0.5 * y, 0.76 * z}, {0.05 * x, 0.5 * y, 0.88 * z}))) {
    return false;
  }
  return std::none_of(objects.begin(), objects.end(), [&](const StreetObject& other) {
    const auto [u, v, w] = other.half_extents;
    return other.kind == SynthObjectKind::car && other.id != car.id &&
           std::isfinite(enter_box(other, direction, {-u, -v, -w}, {u, v, w}));
  });
}

TEST(Street, AThirdOfTheRaysOnCarWindowsIsLost) {
  double met = 0;
  double lost = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto [cloud, objects] = make_street_frame({128'000, seed}, 0);
    for (const StreetObject& car : objects) {
      if (car.kind != SynthObjectKind::car || std::hypot(car.center[0], car.center[1]) > 15) continue;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const bool returned = is_return(cloud, i);
        if ((returned && cloud.object[i] != car.id) || !enters_cabin(objects, car, beam_of(cloud, i)))
          continue;
        ++met;
        lost += !returned;
      }
    }
  }
  EXPECT_GT(met, 1000);
  // Five standard errors, and a little for the rays that end on the hood or on a person before the car.
  EXPECT_NEAR(lost / met, 1.0 / 3, 5 * std::sqrt(2.0 / 9 / met) + 0.01);
}

TEST(Street, NothingBehindASolidIsSeen) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const auto& [cloud, objects] = street_sweep(seed);
    std::size_t limited = 0;
    for (std::size_t i = 0; i < cloud.size(); i += 3) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const StreetObject& object : objects) {
        nearest = std::min(nearest, enter_core(object, beam_of(cloud, i)));
      }
      if (is_false_return(cloud, i)) continue;
      ASSERT_LT(range_of(cloud, i), nearest + noise_bound) << "ray " << i;
      limited += nearest < range_of(cloud, i) + 1;
    }
    EXPECT_GT(limited, 3000u) << "too few rays end near a core for this test to say anything";
  }
}

TEST(Street, ReturnsOfAWallLieOnItsFace) {
  const auto& [cloud, objects] = street_sweep(2);
  std::size_t checked = 0;
  for (const StreetObject& object : objects) {
    if (object.kind != SynthObjectKind::wall) continue;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.object[i] != object.id) continue;
      ASSERT_NEAR(range_of(cloud, i), enter_core(object, beam_of(cloud, i)), noise_bound);
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000u);
}

TEST(Street, RangeNoiseHasItsDeviationAlongTheRay) {
  const auto& [cloud, objects] = street_sweep(2);
  double sum = 0;
  double squares = 0;
  double n = 0;
  for (const StreetObject& object : objects) {
    if (object.kind != SynthObjectKind::wall) continue;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.object[i] != object.id) continue;
      const double noise = range_of(cloud, i) - enter_core(object, beam_of(cloud, i));
      sum += noise;
      squares += noise * noise;
      ++n;
    }
  }
  EXPECT_NEAR(sum / n, 0, 5 * street_range_noise / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), street_range_noise, 5 * street_range_noise / std::sqrt(2 * n));
}

}  // namespace
}  // namespace pcl_bv::detail
