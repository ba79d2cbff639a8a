// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes that are clear of a surface by a little more than the margin that relation() names are apart or held,
// those by a little less are not: judged in long double, at all sizes and places.

#include "box_relation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "exact.h"
#include "executions.h"
#include "pcl_bv/numeric/constants.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;
using Eigen::Vector3d;
using Long = long double;
using LongVector = Eigen::Matrix<Long, 3, 1>;

constexpr Long kLess = 0.98L, kMore = 1.02L;  // of the margin

LongVector along_axes(const ConvexRegion& region, const PlainBox& box) {
  const LongVector at =
      (box.low.cast<Long>() + box.high.cast<Long>()) / 2 - vector(region.center).cast<Long>();
  LongVector along;
  for (std::size_t i = 0; i < 3; ++i)
    along[static_cast<int>(i)] =
        std::abs(at[0] * region.axes[i][0] + at[1] * region.axes[i][1] + at[2] * region.axes[i][2]);
  return along;
}

LongVector reach_along_axes(const ConvexRegion& region, const PlainBox& box) {
  const LongVector half = (box.high.cast<Long>() - box.low.cast<Long>()) / 2;
  LongVector reach;
  for (std::size_t i = 0; i < 3; ++i)
    reach[static_cast<int>(i)] = half[0] * std::abs(region.axes[i][0]) +
                                 half[1] * std::abs(region.axes[i][1]) +
                                 half[2] * std::abs(region.axes[i][2]);
  return reach;
}

Long margin(const ConvexRegion& region, const PlainBox& box) {
  const Long size = box.low.cast<Long>().lpNorm<1>() + box.high.cast<Long>().lpNorm<1>() +
                    vector(region.center).cast<Long>().lpNorm<1>() + Long(region.radius);
  return 0x1p-38L * size + 4 * Long(region.surface_error) + 0x1p-480L;
}

constexpr int kRounds = test::kFewCases ? 1000 : 20'000;

// Boxes of all sizes, flat ones and points among them, about regions of all sizes: each number is now and
// then the one that the margin depends on.
class Cases {
 public:
  void each(const std::function<void(ConvexRegion, const PlainBox&)>& ask) {
    for (int round = 0; round < kRounds; ++round) {
      const double place = size(), away = size(), extent = size();
      ConvexRegion region;
      region.center = coordinates(random_.vector(place));
      const Eigen::Matrix3d axes =
          round % 3 == 0 ? Eigen::Matrix3d::Identity().eval() : random_.isometry(1).linear().eval();
      for (int i = 0; i < 3; ++i)
        region.axes[static_cast<std::size_t>(i)] = {axes(0, i), axes(1, i), axes(2, i)};
      if (round % 4 == 0) region.surface_error = 1e-11 * size();
      Vector3d half = random_.vector(extent).cwiseAbs();
      if (round % 5 == 0) half[round % 3] = 0;
      if (round % 7 == 0) half.setZero();
      const Vector3d middle =
          (round % 2 == 0 ? vector(region.center) : Vector3d::Zero()) + random_.vector(away);
      ask(region, {middle - half, middle + half});
    }
  }
  double size() { return round_numbers_[static_cast<std::size_t>(random_.uniform(0, 6))]; }
  double uniform(double low, double high) { return random_.uniform(low, high); }

 private:
  std::array<double, 6> round_numbers_ = {0, 1e-150, 1e-3, 1, 1e3, 1e6};
  Random random_{1};
};

// `region(t)` is one whose surface is clear of the box by t margins, on that side.
using RegionAt = std::function<ConvexRegion(Long)>;

void expect_apart_from(const RegionAt& region, const PlainBox& box) {
  ASSERT_EQ(relation(region(kMore), box), Relation::outside);
  ASSERT_EQ(relation(region(kLess), box), Relation::crossing);
}

void expect_held_by(const RegionAt& region, const PlainBox& box) {
  ASSERT_EQ(relation(region(kMore), box), Relation::inside);
  ASSERT_EQ(relation(region(kLess), box), Relation::crossing);
}

TEST(BoxRelation, ToABallIsClearBeyondTheMargin) {
  int apart = 0;
  Cases().each([&](ConvexRegion ball, const PlainBox& box) {
    ball.shape = RegionShape::ball;
    const LongVector at = ((box.low.cast<Long>() + box.high.cast<Long>()) / 2 -
                           vector(ball.center).cast<Long>())
                              .cwiseAbs(),
                     half = (box.high.cast<Long>() - box.low.cast<Long>()) / 2;
    const Long near = (at - half).cwiseMax(Long(0)).norm(), far = (at + half).norm(),
               least = margin(ball, box);
    const auto of_radius = [&](Long radius) {
      ball.radius = static_cast<double>(radius);
      return ball;
    };
    if (near > kMore * least) {
      ++apart;
      expect_apart_from([&](Long t) { return of_radius((near - t * least) / (1 + t * 0x1p-38L)); }, box);
    }
    expect_held_by([&](Long t) { return of_radius((far + t * least) / (1 - t * 0x1p-38L)); }, box);
  });
  EXPECT_GT(apart, kRounds / 5);
}

TEST(BoxRelation, ToPlanesIsClearBeyondTheMargin) {
  Cases().each([&](ConvexRegion region, const PlainBox& box) {
    region.shape = RegionShape::planes;
    const Long least = margin(region, box);
    const LongVector reach = reach_along_axes(region, box),
                     at = (box.low.cast<Long>() + box.high.cast<Long>()) / 2 -
                          vector(region.center).cast<Long>();
    for (std::size_t i = 0; i < 3; ++i) {
      const Direction n = region.axes[i];
      const Long along = n[0] * at[0] + n[1] * at[1] + n[2] * at[2], far = reach[static_cast<int>(i)];
      const auto of_limit = [&](Long limit, double others) {
        region.planes.assign(3, {n[0], n[1], n[2], others});
        region.planes[i].limit = static_cast<double>(limit);
        return region;
      };
      expect_apart_from([&](Long t) { return of_limit(along - far - t * least, 1e9); }, box);
      expect_held_by([&](Long t) { return of_limit(along + far + t * least, 1e9); }, box);
      EXPECT_EQ(relation(of_limit(along + far + 2 * least, static_cast<double>(along)), box),
                Relation::crossing);
    }
  });
}

TEST(BoxRelation, ToSlabsIsClearBeyondTheMargin) {
  int apart = 0;
  Cases().each([&](ConvexRegion region, const PlainBox& box) {
    region.shape = RegionShape::slabs;
    const Long least = margin(region, box);
    const LongVector reach = reach_along_axes(region, box), at = along_axes(region, box);
    for (int i = 0; i < 3; ++i) {
      const auto of_slab = [&](Long slab) {
        region.slab.fill(1e9);
        region.slab[static_cast<std::size_t>(i)] = static_cast<double>(slab);
        return region;
      };
      if (at[i] - reach[i] > kMore * least) {
        ++apart;
        expect_apart_from([&](Long t) { return of_slab(at[i] - reach[i] - t * least); }, box);
      }
      expect_held_by([&](Long t) { return of_slab(at[i] + reach[i] + t * least); }, box);
    }
  });
  EXPECT_GT(apart, kRounds / 2);
}

// The radius at which the body's surface is t margins from the box, which depends on the radius in turn.
// `side` is -1 for the nearest of the box, 1 for the farthest.
double radius_at(ConvexRegion region, const PlainBox& box, int side, Long t) {
  const LongVector reach = reach_along_axes(region, box), at = along_axes(region, box);
  for (int round = 0; round < 4; ++round) {
    LongVector weighted;
    for (std::size_t i = 0; i < 3; ++i) {
      const int k = static_cast<int>(i);
      const Long beyond = at[k] + side * (reach[k] + t * margin(region, box)) - region.core[i];
      weighted[k] = region.weight[i] * std::max(beyond, Long(0));
    }
    region.radius = static_cast<double>(weighted.norm());
  }
  return region.radius;
}

TEST(BoxRelation, ToARoundBodyIsClearBeyondTheMargin) {
  Cases cases;
  int apart = 0;
  cases.each([&](ConvexRegion region, const PlainBox& box) {
    region.shape = RegionShape::rounded;
    const LongVector at = along_axes(region, box);
    for (std::size_t i = 0; i < 3; ++i) {
      region.weight[i] = std::array{0.0, 1e-3, 1.0, 1.0, 1e3}[static_cast<std::size_t>(cases.uniform(0, 5))];
      region.core[i] = std::max(0.0, cases.uniform(-1, 0.8)) * static_cast<double>(at[static_cast<int>(i)]);
    }
    const auto of_radius = [&](int side) {
      return [&, side](Long t) {
        region.radius = radius_at(region, box, side, t);
        return region;
      };
    };
    if (radius_at(region, box, -1, 1.1L) > 0) {
      ++apart;
      expect_apart_from(of_radius(-1), box);
    }
    if (!(radius_at(region, box, 1, 0.9L) > 1e-145)) return;
    expect_held_by(of_radius(1), box);
    const ConvexRegion holding = of_radius(1)(2);
    for (int i = 0; i < 3; ++i) {
      ConvexRegion cut = holding;
      cut.slab[static_cast<std::size_t>(i)] = static_cast<double>(at[i]);
      EXPECT_EQ(relation(cut, box), Relation::crossing);
    }
  });
  EXPECT_GT(apart, kRounds / 5);
}

// The margin is 3 * 2^-38 here, which the numbers hold without rounding.
TEST(BoxRelation, AtTheMarginIsNotClear) {
  const PlainBox box = {{1, 0, 0}, {1, 0, 0}};
  ConvexRegion region;
  region.axes = {Direction{1, 0, 0}, Direction{0, 1, 0}, Direction{0, 0, 1}};
  for (const RegionShape shape : {RegionShape::ball, RegionShape::rounded}) {
    region.shape = shape;
    for (const double radius : {1 - 0x3p-38, 1 + 0x3p-38}) {
      region.radius = radius;
      EXPECT_EQ(relation(region, box), Relation::crossing);
    }
    region.radius = 1 - 0x1.9p-37;
    EXPECT_EQ(relation(region, box), Relation::outside);
    region.radius = 1 + 0x1.9p-37;
    EXPECT_EQ(relation(region, box), Relation::inside);
  }
  region.radius = 0;  // and 2 * 2^-38 here
  for (const double limit : {1 - 0x1p-37, 1 + 0x1p-37}) {
    region.shape = RegionShape::planes;
    region.planes = {{1, 0, 0, limit}};
    EXPECT_EQ(relation(region, box), Relation::crossing);
    region.shape = RegionShape::slabs;
    region.slab = {limit, 1, 1};
    EXPECT_EQ(relation(region, box), Relation::crossing);
  }
}

// A flat ellipsoid: z is the margin itself, by 8 * 2^-38 and four doubts.
TEST(BoxRelation, ToAFlatBodyIsByItsOtherAxesWhereItCannotBeToldAlongOne) {
  ConvexRegion disk;
  disk.shape = RegionShape::rounded;
  disk.axes = {Direction{1, 0, 0}, Direction{0, 1, 0}, Direction{0, 0, 1}};
  disk.surface_error = 0.25;
  disk.weight[2] = kInfinity;
  const Vector3d at(3 - 0x1p-35, 0, 1 + 0x1p-35);
  EXPECT_EQ(relation(disk, {at, at}), Relation::outside);
  disk.radius = 2.5;
  EXPECT_EQ(relation(disk, {at, at}), Relation::crossing);
}

TEST(BoxRelation, ToABoxIsExact) {
  const Vector3d low(-1, 2, 5), high(3, 4, 9);
  ConvexRegion region;
  const auto of_sides = [&](const Vector3d& least, const Vector3d& most) {
    region.low = coordinates(least), region.high = coordinates(most);
    return relation(region, {low, high});
  };
  EXPECT_EQ(of_sides(low, high), Relation::inside);
  EXPECT_EQ(of_sides(Vector3d::Constant(-kInfinity), Vector3d::Constant(kInfinity)), Relation::inside);
  for (int k = 0; k < 3; ++k) {
    const auto moved = [&](const Vector3d& from, double to, double towards) {
      Vector3d side = from;
      side[k] = towards == 0 ? to : std::nextafter(to, towards);
      return side;
    };
    EXPECT_EQ(of_sides(moved(low, low[k], kInfinity), high), Relation::crossing);
    EXPECT_EQ(of_sides(low, moved(high, high[k], -kInfinity)), Relation::crossing);
    EXPECT_EQ(of_sides(moved(low, high[k], 0), moved(high, 100, 0)), Relation::crossing);
    EXPECT_EQ(of_sides(moved(low, high[k], kInfinity), moved(high, 100, 0)), Relation::outside);
    EXPECT_EQ(of_sides(moved(low, -100, 0), moved(high, low[k], 0)), Relation::crossing);
    EXPECT_EQ(of_sides(moved(low, -100, 0), moved(high, low[k], -kInfinity)), Relation::outside);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
