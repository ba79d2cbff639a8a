// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A box that can be skipped has one verdict for all its points, and none of them is kept.
#include "commands/pcd_bv/skip_predicate.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "pcl_bv/fitting/fit.h"
#include "pcl_bv/volumes/any_volume.h"
#include "pipeline/filter.h"

namespace pcl_bv::test {
using namespace detail;
namespace {

class SkipPredicate : public testing::Test {
 protected:
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  Eigen::Vector3d place(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }

  Eigen::Matrix3d axes() {
    const Eigen::Vector3d v = place(1);
    return Eigen::Quaterniond(number(-1, 1), v.x(), v.y(), v.z()).normalized().toRotationMatrix();
  }

  Hull thin_tetrahedron(const Eigen::Vector3d& center) {
    std::vector<double> corners;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d corner = center + Eigen::Vector3d(number(-9, 9), number(-9, 9), number(-2, 2));
      corners.insert(corners.end(), corner.data(), corner.data() + 3);
    }
    return fit_hull(packed_points(reinterpret_cast<const std::byte*>(corners.data()), ScalarType::float64, 4))
        .volume;
  }

  // With slabs along axes or, if `oblique`, only between them, so that its corners are sharp.
  static Kdop kdop(const Eigen::Vector3d& center, double size, bool oblique) {
    if (!oblique) {
      Kdop box(KdopSet::dop14());
      return box.extend(center).extend(center + Eigen::Vector3d(size, size / 2, size / 3));
    }
    const auto set = std::make_shared<const KdopSet>(
        std::vector<Eigen::Vector3d>{{1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {1, -1, -1}});
    Kdop kdop(set);
    return kdop.extend(center).extend(center + Eigen::Vector3d(size, size / 2, size / 3));
  }

  AnyVolume any_volume() {
    const Eigen::Vector3d center = place(50), half(number(1, 9), number(1, 9), number(0.1, 9));
    const Eigen::Matrix3d turned = axes();
    switch (random_() % 7) {
      case 0:
        return Sphere(center, 2 * half.x());
      case 1:
        return Obb(center, turned, half);
      case 2:
        return Cylinder(center, turned.col(0), half.x(), half.y());
      case 3:
        return Ellipsoid(center, turned, half);
      case 4:
        return thin_tetrahedron(center);
      case 5:
        return kdop(center, half.x(), random_() % 2 == 0);
      default: {
        const Eigen::Vector3d at = turned.transpose() * center;
        const Eigen::Vector2d low = at.head<2>();
        return Prism(turned, {low, low + Eigen::Vector2d(half.x(), 0), low + Eigen::Vector2d(0, half.y())},
                     at.z(), at.z() + half.z());
      }
    }
  }

  FilterConfig any_filter() {
    FilterConfig filter;
    filter.range_min = random_() % 2 == 0 ? 0 : number(0, 20);
    filter.range_max = random_() % 3 == 0 ? std::numeric_limits<double>::infinity() : number(20, 80);
    for (const bool keep : {true, true, false}) {
      if (random_() % 2 == 0) continue;
      filter.regions.push_back({{}, keep, number(0, 5), {any_volume()}});
    }
    if (random_() % 3 == 0) {
      filter.own_box_min = place(20);
      filter.own_box_max = *filter.own_box_min + Eigen::Vector3d(4, 5, 6);
    }
    return filter;
  }

  // Anywhere, or where a region ends.
  LasBox any_box(const FilterConfig& filter) {
    Eigen::Vector3d low = place(60);
    double side = number(0.1, 25);
    if (!filter.regions.empty() && random_() % 2 == 0) {
      const RegionConfig& region = filter.regions[random_() % filter.regions.size()];
      const Eigen::Vector3d axis = (random_() % 2 == 0 ? 1 : -1) * Eigen::Vector3d::Unit(random_() % 3);
      low = support(region.volumes[0], axis) + region.padding * (place(1.5) + axis);
      side = number(0.1, 1) * region.padding;
    }
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

TEST_F(SkipPredicate, AcceptsBoxesWithOneVerdictThatDropsEachOfTheirPoints) {
  std::size_t by_verdict[4] = {};
  for (int run = 0; run < 3000; ++run) {
    const FilterConfig config = any_filter();
    const PointFilter filter(config, {});
    const BoxPredicate can_skip = make_skip_predicate(config, filter.kept_extents());
    FilterScratch scratch;
    for (int i = 0; i < 8; ++i) {
      const LasBox box = any_box(config);
      if (!can_skip(box)) continue;
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

TEST_F(SkipPredicate, IsEmptyIfDroppedPointsAreShownOrCounted) {
  Options options;
  options.pipeline.ground.method = GroundMethod::none;
  options.pipeline.filter.range_max = 10;
  const auto skips = [&](const Job& job) {
    return static_cast<bool>(make_skip_predicate(job, options, FramePipeline(options.pipeline)));
  };
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

// The position of the sensor, the ground and necks are found with points that the filter drops.
TEST_F(SkipPredicate, IsEmptyIfAStageReadsDroppedPoints) {
  Options options;
  options.pipeline.filter.range_max = 10;
  const auto skips = [&] {
    return static_cast<bool>(make_skip_predicate({"a.laz"}, options, FramePipeline(options.pipeline)));
  };
  for (const GroundMethod method :
       {GroundMethod::none, GroundMethod::slope, GroundMethod::plane, GroundMethod::zones}) {
    options.pipeline.ground.method = method;
    EXPECT_EQ(skips(), method == GroundMethod::none || method == GroundMethod::slope);
  }
  options.pipeline.ground.method = GroundMethod::none;
  options.pipeline.cluster.refine = Refine::neck;
  EXPECT_FALSE(skips());
}

}  // namespace
}  // namespace pcl_bv::test
