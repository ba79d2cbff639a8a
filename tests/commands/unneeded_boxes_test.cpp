// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A box that is not needed has one verdict for all its points, and none of them is kept.
#include "commands/pcd_bv/unneeded_boxes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "pcl_bv/volumes/sphere.h"
#include "pipeline/filter.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

class UnneededBoxes : public testing::Test {
 protected:
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  Eigen::Vector3d place(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }

  FilterConfig any_filter() {
    FilterConfig filter;
    filter.range_min = random_() % 2 == 0 ? 0 : number(0, 20);
    filter.range_max = random_() % 3 == 0 ? std::numeric_limits<double>::infinity() : number(20, 80);
    for (const bool keep : {true, true, false}) {
      if (random_() % 2 == 0) continue;
      const double radius = number(1, 20);
      filter.regions.push_back({{}, keep, number(0, 2), {AnyVolume(Sphere(place(50), radius))}});
    }
    if (random_() % 3 == 0) {
      filter.own_box_min = place(20);
      filter.own_box_max = *filter.own_box_min + Eigen::Vector3d(4, 5, 6);
    }
    return filter;
  }

  LasBox any_box() {
    const Eigen::Vector3d low = place(60);
    const double side = number(0.1, 25);
    return {{low.x(), low.y(), low.z()}, {low.x() + side, low.y() + side, low.z() + side}};
  }

  // The centre, the corners and random points.
  std::vector<double> points_of(const LasBox& box) {
    std::vector<double> points;
    for (std::size_t i = 0; i < 40; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = box.low[axis], high = box.high[axis];
        points.push_back(i == 0   ? low / 2 + high / 2
                         : i <= 8 ? ((i - 1) >> axis & 1U ? high : low)
                                  : number(low, high));
      }
    }
    return points;
  }

  std::mt19937 random_{11};
};

TEST_F(UnneededBoxes, HaveOneVerdictThatDropsEachOfTheirPoints) {
  std::size_t by_verdict[4] = {};
  for (int run = 0; run < 3000; ++run) {
    const FilterConfig config = any_filter();
    const SkipsBox is_unneeded = boxes_without_kept_points(config);
    const PointFilter filter(config, {});
    FilterScratch scratch;
    for (int i = 0; i < 4; ++i) {
      const LasBox box = any_box();
      if (!is_unneeded(box)) continue;
      const std::vector<double> points = points_of(box);
      filter.classify(packed_points(reinterpret_cast<const std::byte*>(points.data()), ScalarType::float64,
                                    points.size() / 3),
                      {}, scratch);
      for (const Verdict verdict : scratch.verdicts)
        ASSERT_EQ(verdict, scratch.verdicts[0]) << "run " << run;
      ASSERT_NE(scratch.verdicts[0], Verdict::kept) << "run " << run;
      ++by_verdict[static_cast<std::size_t>(scratch.verdicts[0])];
    }
  }
  EXPECT_GT(by_verdict[static_cast<std::size_t>(Verdict::range)], 500U);
  EXPECT_GT(by_verdict[static_cast<std::size_t>(Verdict::region)], 500U);
}

TEST_F(UnneededBoxes, AreNoneIfDroppedPointsAreShownOrCounted) {
  Options options;
  options.pipeline.filter.range_max = 10;
  const auto skips = [&](const Job& job) { return static_cast<bool>(unneeded_boxes(job, options)); };
  EXPECT_TRUE(skips({"a.copc.laz"}));
  EXPECT_FALSE(skips({"a.las"}));
  EXPECT_FALSE(skips({.input = "a.laz", .labels = "b.pcd"}));
  EXPECT_FALSE(skips({.input = "a.laz", .image = "b.png"}));
  EXPECT_FALSE(skips({.input = "a.laz", .error = "none"}));
  options.info = true;
  EXPECT_FALSE(skips({"a.laz"}));
  options.info = false;
  options.pipeline.filter.range_max = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(skips({"a.laz"}));
  options.pipeline.filter.regions.push_back({{}, false, 0, {AnyVolume(Sphere({0, 0, 0}, 1))}});
  EXPECT_FALSE(skips({"a.laz"}));
  options.pipeline.filter.regions[0].keep = true;
  EXPECT_TRUE(skips({"a.laz"}));
}

}  // namespace
}  // namespace pcl_bv::test
