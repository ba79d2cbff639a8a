// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A window is what was made of its sweeps at once.

#include "pcl_bv/trees/sweep_window.h"

#include <gtest/gtest.h>

#include <deque>

#include "clouds.h"
#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/fitting/methods.h"

namespace pcl_bv {
namespace {

using Cloud = test::TestCloud<float>;

// Sweeps of different sizes, some empty, from a sensor that moves.
std::vector<Cloud> sweeps(std::size_t count, std::size_t points) {
  std::vector<Cloud> all;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t n = i % 5 == 3 ? 0 : points + 37 * (i % 4);
    all.push_back(test::gaussian<float>(n, static_cast<unsigned>(i + 1), 1 + 0.1 * static_cast<double>(i % 3),
                                        0.5 * static_cast<double>(i)));
    if (i % 4 == 1 && n > 0) all.back().xyz[4] = std::numeric_limits<float>::quiet_NaN();
  }
  return all;
}

Cloud joined(const std::deque<const Cloud*>& clouds) {
  Cloud all;
  for (const Cloud* cloud : clouds)
    all.xyz.insert(all.xyz.end(), cloud->xyz.begin(), cloud->xyz.end());
  return all;
}

void expect_window(const SweepWindow& window, const std::deque<const Cloud*>& inside) {
  const Cloud all = joined(inside);
  ASSERT_EQ(window.size(), inside.size());
  ASSERT_EQ(window.point_count(), all.size());
  ASSERT_EQ(window.merged().size(), all.size());
  const Partial at_once(all.view(), static_cast<std::size_t>(window.first_index()));
  ASSERT_EQ(window.merged().to_bytes(), at_once.to_bytes());
  for (const std::string name :
       {"aabb", "dop14", "dop26", "sphere", "hull", "obb-pca", "obb-min", "cylinder"}) {
    const Method& method = *find_method(name);
    AnyVolume found, expected;
    const EstimationResult result = window.merged().fit(method, found);
    at_once.fit(method, expected);
    ASSERT_EQ(found, expected) << name;
    if (name != "aabb" && name != "dop26" && name != "hull") continue;
    const EstimationResult of_cloud = method.fit(all.view(), expected, {});
    ASSERT_EQ(found, expected) << name;
    ASSERT_EQ(result.used, of_cloud.used);
    ASSERT_EQ(result.dropped, of_cloud.dropped);
  }
}

void expect_slides(std::size_t capacity, std::size_t points) {
  const std::vector<Cloud> all = sweeps(3 * capacity + 2, points);
  SweepWindow window(capacity);
  std::deque<const Cloud*> inside;
  for (const Cloud& sweep : all) {
    window.add(sweep.view());
    inside.push_back(&sweep);
    if (inside.size() > capacity) inside.pop_front();
    ASSERT_NO_FATAL_FAILURE(expect_window(window, inside));
  }
  for (; !inside.empty(); inside.pop_front(), window.drop_oldest())
    ASSERT_NO_FATAL_FAILURE(expect_window(window, inside));
  EXPECT_EQ(window.size(), 0U);
  EXPECT_EQ(window.merged().size(), 0U);
  window.drop_oldest();
}

TEST(SweepWindow, OfFewPointsIsWhatIsMadeOfItsSweepsAtOnce) {
  expect_slides(4, 60);
}
TEST(SweepWindow, OfManyPointsIsWhatIsMadeOfItsSweepsAtOnce) {
  expect_slides(3, 6000);
}
TEST(SweepWindow, OfOneSweepIsTheLastOne) {
  expect_slides(1, 500);
}

TEST(SweepWindow, NumbersPointsAsTheyComeWhateverTheirViewsCallThem) {
  const auto cloud = test::gaussian<float>(5000, 9);
  SweepWindow window(2), whole(2);
  window.add(cloud.view().slice(100, 4900));
  window.add(cloud.view().slice(0, 300));
  Cloud other;
  other.xyz.assign(cloud.xyz.begin() + 300, cloud.xyz.end());
  other.xyz.insert(other.xyz.end(), cloud.xyz.begin(), cloud.xyz.begin() + 900);
  EXPECT_EQ(window.merged().to_bytes(), Partial(other.view()).to_bytes());
}

TEST(SweepWindow, RefusesWhatItCannotHoldAndStaysAsItWas) {
  EXPECT_THROW(SweepWindow(0), std::invalid_argument);
  SweepWindow window(2);
  const auto floats = test::gaussian<float>(50, 1);
  const auto doubles = test::gaussian<double>(50, 1);
  window.add(floats.view());
  const auto bytes = window.merged().to_bytes();
  EXPECT_THROW(window.add(doubles.view()), std::invalid_argument);
  EXPECT_THROW(window.add(doubles.view().slice(0, 1)), std::invalid_argument);
  const std::int32_t indices[] = {1, 2};
  PointView some = floats.view();
  some.indices = indices;
  some.count = 2;
  EXPECT_THROW(window.add(some), std::invalid_argument);
  EXPECT_EQ(window.size(), 1U);
  EXPECT_EQ(window.merged().to_bytes(), bytes);
  window.add(doubles.view().slice(0, 0));  // no points are of no type
  EXPECT_THROW(window.add(doubles.view()), std::invalid_argument);
  window.add(floats.view());  // now one sweep is dropped, and the others are merged from their end
  EXPECT_THROW(window.add(doubles.view().slice(0, 1)), std::invalid_argument);
  while (window.size() > 0)
    window.drop_oldest();
  window.add(doubles.view());
  EXPECT_EQ(window.point_count(), 50U);
}

}  // namespace
}  // namespace pcl_bv
