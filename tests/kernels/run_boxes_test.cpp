// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes around runs of 64 points.

#include "pcl_bv/kernels/run_boxes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "clouds.h"
#include "pcl_bv/kernels/point_groups.h"

namespace pcl_bv {
namespace {

template <typename T>
std::vector<RunBox> boxes_of(const PointView& points, Isa isa) {
  std::vector<RunBox> boxes((points.count + kRunPoints - 1) / kRunPoints);
  run_boxes(isa, points, boxes.data());
  return boxes;
}

template <typename T>
void expect_boxes_hold_their_runs() {
  auto cloud = test::gaussian<T>(10 * kRunPoints + 21, 3);
  cloud.xyz[7] = std::numeric_limits<T>::quiet_NaN();
  cloud.xyz[300] = std::numeric_limits<T>::infinity();
  for (std::size_t i = 3 * kRunPoints; i < 6 * kRunPoints; ++i)
    cloud.xyz[i] = std::numeric_limits<T>::quiet_NaN();  // of a whole run
  const std::vector<RunBox> expected = boxes_of<T>(cloud.view(), Isa::scalar);
  EXPECT_GT(expected[1].low[0], expected[1].high[0]);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const T x = cloud.xyz[3 * i + k];
      const RunBox& box = expected[i / kRunPoints];
      EXPECT_TRUE(std::isnan(x) || (box.low[k] <= x && x <= box.high[k])) << i;
    }
  }
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

TEST(RunBoxes, HoldTheirRunsOnEveryInstructionSet) {
  expect_boxes_hold_their_runs<float>();
  expect_boxes_hold_their_runs<double>();
}

}  // namespace
}  // namespace pcl_bv
