// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/kernels/deskew.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

#include "clouds.h"
#include "pcl_bv/points/point_groups.h"

namespace pcl_bv::detail {
namespace {

using Vector = Eigen::Vector3d;

// exp(t * motion) p, from the closed form in double.
Vector moved_by_definition(const SensorMotion& motion, double t, const Vector& p) {
  const Vector v = Eigen::Map<const Vector>(motion.velocity.data()),
               w = Eigen::Map<const Vector>(motion.angular_velocity.data());
  const double speed = w.norm();
  if (speed == 0) return p + t * v;
  const Vector axis = w / speed;
  const Eigen::AngleAxisd turn(speed * t, axis);
  // A screw: the velocity along the axis stays, the rest turns about a point beside the origin.
  const Vector along = axis.dot(v) * axis, centre = w.cross(v - along) / (speed * speed);
  return turn * (p - centre) + centre + t * along;
}

template <typename T>
std::vector<T> deskewed(Isa isa, const PointView& points, const std::vector<float>& seconds,
                        const SensorMotion& motion) {
  std::vector<T> xyz(3 * points.count);
  deskew(isa, points, seconds.data(), motion, reinterpret_cast<std::byte*>(xyz.data()));
  return xyz;
}

std::vector<float> times_for(std::size_t points) {
  std::vector<float> seconds(points);
  for (std::size_t i = 0; i < points; ++i)
    seconds[i] = 0.1F * static_cast<float>(i % 997) / 997 - 0.03F;
  return seconds;
}

const SensorMotion kDrive{{15, -1, 0.5}, {0.3, -0.2, 4}};  // at most 0.28 radians in 0.07 s

template <typename T>
void expect_as_defined(double tolerance) {
  const test::TestCloud<T> cloud = test::gaussian<T>(5003, 7);
  const std::vector<float> seconds = times_for(cloud.size());
  for (const SensorMotion& motion : {kDrive, SensorMotion{{10, 0, 0}, {}}, SensorMotion{{}, {0, 0, 0.5}}}) {
    const std::vector<T> found = deskewed<T>(Isa::scalar, cloud.view(), seconds, motion);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vector p(cloud.xyz[3 * i], cloud.xyz[3 * i + 1], cloud.xyz[3 * i + 2]);
      const Vector expected = moved_by_definition(motion, seconds[i], p);
      const Vector error = Vector(found[3 * i], found[3 * i + 1], found[3 * i + 2]) - expected;
      ASSERT_LT(error.norm(), tolerance * (1 + expected.norm())) << i;
    }
  }
}

TEST(Deskew, MovesPointsAlongTheScrewMotion) {
  expect_as_defined<float>(4e-7);
  expect_as_defined<double>(2e-9);
}

template <typename T>
void expect_the_same_bits() {
  for (const std::size_t n : {0, 1, 3, 7, 8, 15, 16, 17, 31, 33, 100, 5003}) {
    const test::TestCloud<T> cloud = test::gaussian<T>(n, n + 1);
    const std::vector<float> seconds = times_for(n);
    const std::vector<T> expected = deskewed<T>(Isa::scalar, cloud.view(), seconds, kDrive);
    const test::Records<T> wide(cloud, 32, 4), padded(cloud, 4 * sizeof(T)), narrow(cloud, 24 + 3 * sizeof(T), 24);
    std::vector<std::int32_t> all(n);
    std::iota(all.begin(), all.end(), 0);
    const PointView listed = cloud.view().subset(all);
    const PointGroups groups(cloud.view());
    for (const Isa isa : usable_isas()) {
      SCOPED_TRACE(std::string(isa_name(isa)) + ", " + std::to_string(n));
      for (const PointView& view :
           {cloud.view(), wide.view(), padded.view(), narrow.view(), listed, groups.view()})
        EXPECT_EQ(deskewed<T>(isa, view, seconds, kDrive), expected);
    }
  }
}

TEST(Deskew, GivesTheSameBitsOnEverySetAndInEveryLayout) {
  expect_the_same_bits<float>();
  expect_the_same_bits<double>();
}

TEST(Deskew, LeavesPointsWithoutReturnAndInvalidPointsAsTheyAre) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(),
                  kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kMax = std::numeric_limits<float>::max();
  const std::vector<float> xyz{0, 0, 0, kNaN, 1, 2, 3, kInfinity, 4, 0, -0.F, 0, 1, 2, 3, kMax, kMax, 0};
  const std::vector<float> seconds(6, 0.1F);
  for (const Isa isa : usable_isas()) {
    const std::vector<float> found =
        deskewed<float>(isa, PointView::of(xyz.data(), 3 * sizeof(float), 6), seconds, kDrive);
    for (const std::size_t point : {0, 1, 2, 3, 5})
      EXPECT_EQ(std::memcmp(&found[3 * point], &xyz[3 * point], 3 * sizeof(float)), 0)
          << isa_name(isa) << ' ' << point;
    EXPECT_NE(found[12], 1) << isa_name(isa);
  }
}

TEST(Deskew, AtTimeZeroChangesNoPoint) {
  const test::TestCloud<float> cloud = test::gaussian<float>(100, 3);
  const std::vector<float> seconds(100, 0);
  for (const Isa isa : usable_isas())
    EXPECT_EQ(deskewed<float>(isa, cloud.view(), seconds, kDrive), cloud.xyz) << isa_name(isa);
}

}  // namespace
}  // namespace pcl_bv::detail
