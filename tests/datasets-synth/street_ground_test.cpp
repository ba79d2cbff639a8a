// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The ground of the street: slope, curbs, and the reflections below it.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "street_fixture.h"

namespace pcl_bv::detail {
namespace {

TEST(StreetGround, RoadIsBelowTheSensorByItsHeight) {
  EXPECT_EQ(street_ground_height(0, 0), -1.73);
}

TEST(StreetGround, ClimbsFivePercentAlongX) {
  for (const double y : {-20.0, -3.0, 0.0, 5.0, 20.0}) {
    EXPECT_NEAR(street_ground_height(10, y) - street_ground_height(-10, y), 0.05 * 20, 1e-12);
  }
}

TEST(StreetGround, SidewalksAreHigherByTheCurb) {
  for (const double y : {street_curb_left, street_curb_right}) {
    const double outward = y > 0 ? 1e-6 : -1e-6;
    EXPECT_NEAR(street_ground_height(3, y + outward) - street_ground_height(3, y - outward), 0.12, 1e-12);
  }
}

/// How far a ground return lies from the ground, along its ray, at a curb the nearer of face and levels.
double distance_to_ground(const SynthCloud& cloud, std::size_t i) {
  const Vector d = beam_of(cloud, i);
  const double range = range_of(cloud, i);
  const double sinking = street_slope * d[0] - d[2];
  std::vector<double> candidates;
  for (const double height : {street_sensor_height, street_sensor_height - street_curb_height}) {
    const double r = height / sinking;
    const double y = r * d[1];
    const bool on_road = y < street_curb_left && y > street_curb_right;
    if (on_road == (height == street_sensor_height)) candidates.push_back(r);
  }
  candidates.push_back((d[1] > 0 ? street_curb_left : street_curb_right) / d[1]);
  double nearest = 1e9;
  for (const double r : candidates)
    nearest = std::min(nearest, std::abs(r - range));
  return nearest;
}

TEST(Street, GroundReturnsLieOnTheGround) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const SynthCloud& cloud = street_sweep(seed).cloud;
    std::size_t ground = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.ground[i] == 0) continue;
      ++ground;
      ASSERT_LT(distance_to_ground(cloud, i), noise_bound) << "ray " << i;
      const Vector p = point_of(cloud, i);
      const double road = street_slope * p[0] - street_sensor_height;
      ASSERT_GT(p[2], road - noise_bound) << "ray " << i;
      ASSERT_LT(p[2], road + street_curb_height + noise_bound) << "ray " << i;
    }
    EXPECT_GT(ground, cloud.size() / 4);
  }
}

struct Line {
  double slope, height;
};

/// Least squares of z over x of the ground returns with y in an interval.
Line fit_ground(const SynthCloud& cloud, double y_low, double y_high) {
  double n = 0, x = 0, z = 0, xx = 0, xz = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vector p = point_of(cloud, i);
    if (cloud.ground[i] == 0 || p[1] < y_low || p[1] > y_high) continue;
    n += 1;
    x += p[0];
    z += p[2];
    xx += p[0] * p[0];
    xz += p[0] * p[2];
  }
  const double slope = (n * xz - x * z) / (n * xx - x * x);
  return {slope, (z - slope * x) / n};
}

TEST(Street, ReturnsShowTheSlopeAndTheCurbs) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const SynthCloud& cloud = street_sweep(seed).cloud;
    const Line road = fit_ground(cloud, street_curb_right + 0.1, street_curb_left - 0.1);
    EXPECT_NEAR(road.slope, 0.05, 2e-4);
    EXPECT_NEAR(road.height, -1.73, 2e-3);
    for (const Line sidewalk :
         {fit_ground(cloud, street_curb_left + 0.1, 30), fit_ground(cloud, -30, street_curb_right - 0.1)}) {
      EXPECT_NEAR(sidewalk.slope, 0.05, 1e-3);
      EXPECT_NEAR(sidewalk.height - road.height, 0.12, 1e-2);
    }
  }
}

TEST(Street, CurbFacesAreSeen) {
  const SynthCloud& cloud = street_sweep(1).cloud;
  for (const double curb : {street_curb_left, street_curb_right}) {
    std::size_t on_face = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vector p = point_of(cloud, i);
      const double above_road = p[2] - (street_slope * p[0] - street_sensor_height);
      on_face +=
          cloud.ground[i] != 0 && std::abs(p[1] - curb) < 0.05 && above_road > 0.03 && above_road < 0.09;
    }
    EXPECT_GT(on_face, 50u) << "curb at y " << curb;
  }
}

TEST(Street, ObjectsAreSeenAboveTheGroundOnly) {
  // Houses reach into the ground, and a ray that is past the ground might meet one there.
  constexpr double road_center = 0.5 * (street_curb_left + street_curb_right);
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const SynthCloud& cloud = street_sweep(seed).cloud;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.object[i] == 0) continue;
      const Vector p = point_of(cloud, i);
      // Noise may carry the wheel of a parked car over the curb.
      const double y = p[1] + (p[1] < road_center ? noise_bound : -noise_bound);
      ASSERT_GT(p[2], street_ground_height(p[0], y) - noise_bound) << "ray " << i;
    }
  }
}

TEST(Street, FalseReturnsLieBelowTheGround) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const SynthCloud& cloud = street_sweep(seed).cloud;
    double ground = 0;
    double below = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      ground += cloud.ground[i];
      if (!is_false_return(cloud, i)) continue;
      ++below;
      const Vector p = point_of(cloud, i);
      // At least 0.15 of the way to the ground beyond it: that much of the sensor's height below it.
      ASSERT_LT(p[2], street_ground_height(p[0], p[1]) - 0.1) << "ray " << i;
    }
    EXPECT_NEAR(below, ground / 700, 5 * std::sqrt(ground / 700));
  }
}

}  // namespace
}  // namespace pcl_bv::detail
