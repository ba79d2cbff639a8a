// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pipeline/deskew/point_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace pcl_bv::detail {
namespace {

constexpr std::int64_t kStamp = 1'700'000'000'000'000'000;

// Points of a sweep whose times are of type T.
template <typename T>
struct TimedPoints {
  std::vector<float> xyz;
  std::vector<T> times;

  explicit TimedPoints(std::size_t count, double first, double step) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = static_cast<float>(i);
      xyz.insert(xyz.end(), {1 + number, 2, 3});
      times.push_back(static_cast<T>(first + step * static_cast<double>(i)));
    }
  }
  PointView view() const { return PointView::of(xyz.data(), 3 * sizeof(float), times.size()); }
  FieldView field() const {
    const char type = std::is_floating_point_v<T> ? 'F' : 'U';
    return {reinterpret_cast<const std::byte*>(times.data()), sizeof(T), type, sizeof(T)};
  }
};

template <typename T>
void expect_times(double first, double step, const char* unit, DeskewTimes::Origin origin, double expected) {
  const TimedPoints<T> points(1000, first, step);
  std::vector<float> seconds(points.times.size());
  const DeskewTimes times =
      PointTimes().read(Isa::automatic, points.field(), points.view(), kStamp, seconds.data());
  ASSERT_EQ(times.problem, DeskewTimes::Problem::none);
  EXPECT_STREQ(times.unit->name, unit);
  EXPECT_EQ(times.origin, origin);
  EXPECT_NEAR(times.first, expected, 1e-6);
  EXPECT_NEAR(times.last, expected + 0.0999, 1e-6);
  EXPECT_EQ(times.outside, 0U);
  ASSERT_EQ(seconds.size(), 1000U);
  EXPECT_NEAR(seconds[10], expected + 0.001, 1e-6);
}

TEST(PointTimes, KnowTheirUnitAndOriginAsDriversWriteThem) {
  using Origin = DeskewTimes::Origin;
  expect_times<std::uint32_t>(0, 1e5, "ns", Origin::stamp, 0);            // t of Ouster
  expect_times<float>(0, 1e-4, "s", Origin::stamp, 0);                    // time of Velodyne
  expect_times<float>(-0.0999F, 1e-4, "s", Origin::stamp, -0.0999);       // the same, stamp at the end
  expect_times<double>(1.7e9, 1e-4, "s", Origin::absolute, 0);            // timestamp of Hesai
  expect_times<double>(1.7e18 + 2e7, 1e5, "ns", Origin::absolute, 0.02);  // timestamp of Livox
  expect_times<std::uint32_t>(0, 100, "us", Origin::stamp, 0);
  expect_times<float>(0, 0.1F, "ms", Origin::stamp, 0);
  expect_times<double>(1234.5, 1e-4, "s", Origin::first_point, 0);  // since the sensor was switched on
  expect_times<double>(1.6e9, 1e-4, "s", Origin::first_point, 0);   // another clock
}

TEST(PointTimes, AreNoneWithoutASweep) {
  std::vector<float> seconds(100);
  PointTimes times;
  const TimedPoints<double> equal(100, 5, 0), slow(100, 0, 1e9), none(0, 0, 0);
  EXPECT_EQ(times.read(Isa::automatic, equal.field(), equal.view(), 0, seconds.data()).problem,
            DeskewTimes::Problem::no_sweep);
  EXPECT_EQ(times.read(Isa::automatic, slow.field(), slow.view(), 0, seconds.data()).problem,
            DeskewTimes::Problem::no_sweep);
  EXPECT_EQ(times.read(Isa::automatic, none.field(), none.view(), 0, seconds.data()).problem,
            DeskewTimes::Problem::no_time);
  TimedPoints<double> nan(100, std::numeric_limits<double>::quiet_NaN(), 1);
  EXPECT_EQ(times.read(Isa::automatic, nan.field(), nan.view(), 0, seconds.data()).problem,
            DeskewTimes::Problem::no_time);
}

// A sweep in columns of 32 beams, of which only beam 5 has returns.
TEST(PointTimes, AreFoundIfOnlyOneBeamHasReturns) {
  TimedPoints<std::uint32_t> points(131'072, 0, 700);
  for (std::size_t i = 0; i < points.times.size(); ++i)
    if (i % 32 != 5) std::fill_n(&points.xyz[3 * i], 3, 0.F);
  std::vector<float> seconds(points.times.size());
  const DeskewTimes times =
      PointTimes().read(Isa::automatic, points.field(), points.view(), 0, seconds.data());
  EXPECT_EQ(times.problem, DeskewTimes::Problem::none);
  EXPECT_NEAR(times.last, 0.0917, 1e-3);
}

// Another clock, and one point far before the others.
TEST(PointTimes, AnOutlierIsNotTheFirstPoint) {
  TimedPoints<double> points(1000, 1.6e9, 1e-4);
  points.times[500] = 1.6e9 - 0.9;
  std::vector<float> seconds(points.times.size());
  const DeskewTimes times =
      PointTimes().read(Isa::automatic, points.field(), points.view(), kStamp, seconds.data());
  EXPECT_EQ(times.origin, DeskewTimes::Origin::first_point);
  EXPECT_EQ(times.outside, 1U);
  EXPECT_NEAR(seconds[0], 0, 1e-6);
  EXPECT_NEAR(seconds[999], 0.0999, 1e-6);
}

TEST(PointTimes, OfPointsOutsideTheSweepAreCountedAndZero) {
  TimedPoints<double> points(1000, 1.7e9, 1e-4);
  points.times[3] = 0;
  points.times[4] = std::numeric_limits<double>::quiet_NaN();
  points.times[5] = 1.8e9;
  points.times[6] = 0;  // without a return, which is usual
  points.xyz[18] = points.xyz[19] = points.xyz[20] = 0;
  std::vector<float> seconds(points.times.size());
  const DeskewTimes times =
      PointTimes().read(Isa::automatic, points.field(), points.view(), kStamp, seconds.data());
  EXPECT_EQ(times.problem, DeskewTimes::Problem::none);
  EXPECT_EQ(times.outside, 3U);
  for (const std::size_t i : {3, 4, 5, 6})
    EXPECT_EQ(seconds[i], 0) << i;
  EXPECT_NEAR(seconds[7], 0.0007, 1e-6);
}

// 64-bit integers are converted in several blocks. The first and last block have one limit each.
TEST(PointTimes, OfARareTypeAreThoseOfDoubles) {
  TimedPoints<std::uint64_t> integers(1500, 1.7e18, 66'000);
  integers.times[700] = 0;
  TimedPoints<double> doubles(1500, 0, 0);
  std::copy(integers.times.begin(), integers.times.end(), doubles.times.begin());
  std::vector<float> expected(1500), seconds(1500);
  const DeskewTimes of_doubles =
      PointTimes().read(Isa::automatic, doubles.field(), doubles.view(), kStamp, expected.data());
  const DeskewTimes times =
      PointTimes().read(Isa::automatic, integers.field(), integers.view(), kStamp, seconds.data());
  EXPECT_EQ(times.problem, DeskewTimes::Problem::none);
  EXPECT_EQ(seconds, expected);
  EXPECT_EQ(times.first, of_doubles.first);
  EXPECT_EQ(times.last, of_doubles.last);
  EXPECT_EQ(times.outside, 1U);
  EXPECT_NEAR(times.last, 0.0989, 1e-4);
}

}  // namespace
}  // namespace pcl_bv::detail
