// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes around runs of 64 points.

#include "pcl_bv/kernels/run_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "clouds.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/points/point_groups.h"

namespace pcl_bv::detail {
namespace {

template <typename T>
std::vector<RunBox> boxes_of(const PointView& points, Isa isa) {
  std::vector<RunBox> boxes((points.count + kRunPoints - 1) / kRunPoints);
  run_boxes(isa, points, boxes.data());
  return boxes;
}

// By definition: what is least and greatest of the numbers that are there, rounded outward.
template <typename T>
void expect_tight(const test::TestCloud<T>& cloud, const std::vector<RunBox>& boxes) {
  for (std::size_t r = 0; r < boxes.size(); ++r) {
    for (std::size_t k = 0; k < 3; ++k) {
      T low = std::numeric_limits<T>::infinity(), high = -low;
      for (std::size_t i = r * kRunPoints; i < std::min((r + 1) * kRunPoints, cloud.size()); ++i) {
        const T x = cloud.xyz[3 * i + k];
        low = x < low ? x : low;
        high = x > high ? x : high;
      }
      ASSERT_EQ(boxes[r].low[k], float_down(low)) << r;
      ASSERT_EQ(boxes[r].high[k], float_up(high)) << r;
    }
  }
}

template <typename T>
void expect_boxes_are_tight() {
  auto cloud = test::gaussian<T>(10 * kRunPoints + 21, 3);
  cloud.xyz[7] = std::numeric_limits<T>::quiet_NaN();
  cloud.xyz[300] = std::numeric_limits<T>::infinity();
  for (std::size_t i = 3 * kRunPoints; i < 6 * kRunPoints; ++i)
    cloud.xyz[i] = std::numeric_limits<T>::quiet_NaN();  // of a whole run
  const std::vector<RunBox> expected = boxes_of<T>(cloud.view(), Isa::scalar);
  EXPECT_GT(expected[1].low[0], expected[1].high[0]);
  expect_tight(cloud, expected);
  const PointGroups groups(cloud.view());
  for (const Isa isa : usable_isas()) {
    for (const PointView& view : {cloud.view(), groups.view()}) {
      const std::vector<RunBox> boxes = boxes_of<T>(view, isa);
      for (std::size_t r = 0; r < boxes.size(); ++r) {
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_EQ(boxes[r].low[k], expected[r].low[k]) << isa_name(isa) << ", " << r;
          ASSERT_EQ(boxes[r].high[k], expected[r].high[k]) << isa_name(isa) << ", " << r;
        }
      }
    }
  }
}

TEST(RunBoxes, AreTheTightOnesOfTheirRunsOnEveryInstructionSet) {
  expect_boxes_are_tight<float>();
  expect_boxes_are_tight<double>();
}

}  // namespace
}  // namespace pcl_bv::detail
