// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Bounds of nodes hold what they bound, in rationals.

#include "pcl_bv/trees/slab_bounds.h"

#include <gtest/gtest.h>

#include "any_volumes.h"
#include "pcl_bv/numeric/directed.h"
#include "pcl_bv/numeric/expansion.h"
#include "pcl_bv/numeric/vector3.h"
#include "scattered_volumes.h"

namespace pcl_bv {
namespace {

using namespace testing;

static_assert(sizeof(SlabBounds<13, float>) == 104);
static_assert(sizeof(SlabBounds<7, float>) == 56);

template <std::size_t N, typename T>
bool holds(const SlabBounds<N, T>& bounds, const ExactPoint& p) {
  for (std::size_t i = 0; i < N; ++i) {
    const CubeDirection& d = kCubeDirections[i];
    const Rational s = d[0] * p[0] + d[1] * p[1] + d[2] * p[2];
    if (std::isfinite(bounds.max[i]) && s > Rational(static_cast<double>(bounds.max[i]))) return false;
    if (std::isfinite(bounds.min[i]) && s < Rational(static_cast<double>(bounds.min[i]))) return false;
  }
  return true;
}

bool is_inside(const AnyVolume& volume, const ExactPoint& p) {
  return std::visit([&](const auto& shape) { return inside(shape, p); }, volume);
}

// Points on the surface, and those nearer than the surface by little, which are surely inside.
std::vector<Vector3d> surface_points(Random& random, const AnyVolume& volume) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < 2 * kMaxDirections + 10; ++i) {
    Vector3d direction = random.vector(1);
    if (i < 2 * kMaxDirections) {
      const CubeDirection& d = kCubeDirections[i / 2];
      direction = (i % 2 == 0 ? 1 : -1) * Vector3d(d[0], d[1], d[2]);
    }
    const Vector3d surface = support(volume, direction);
    points.push_back(surface);
    points.push_back(surface + 0x1p-50 * (center(volume) - surface));
    points.push_back(surface + 0x1p-30 * (center(volume) - surface));
  }
  return points;
}

template <std::size_t N, typename T>
void expect_encloses() {
  Random random(11);
  std::size_t judged = 0;
  for (const Scale& scale : scales()) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      const SlabBounds<N, T> bounds(volume);
      for (const Vector3d& p : surface_points(random, volume)) {
        if (!is_inside(volume, exact(p))) continue;
        ++judged;
        ASSERT_TRUE(holds(bounds, exact(p))) << shape_name(volume) << ", " << scale.name;
        ASSERT_TRUE(bounds.contains(p)) << shape_name(volume) << ", " << scale.name;
      }
    }
  }
  EXPECT_GT(judged, 3000U);
}

TEST(SlabBounds, OfThreeFloatsEnclosesEveryVolumeInExactArithmetic) {
  expect_encloses<3, float>();
}
TEST(SlabBounds, OfSevenFloatsEnclosesEveryVolumeInExactArithmetic) {
  expect_encloses<7, float>();
}
TEST(SlabBounds, OfThirteenFloatsEnclosesEveryVolumeInExactArithmetic) {
  expect_encloses<13, float>();
}
TEST(SlabBounds, OfThirteenDoublesEnclosesEveryVolumeInExactArithmetic) {
  expect_encloses<13, double>();
}

TEST(SlabBounds, OfVolumesAreTight) {
  Random random(12);
  for (const Scale& scale : {scales()[0], scales()[1], scales()[4], scales()[5]}) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      const SlabBounds<13, double> bounds(volume);
      const SlabBounds<13, float> floats(volume);
      const Aabb box = aabb(volume);
      const double size = (box.max() - box.min()).maxCoeff();
      const double room = 1e-11 * size + 1e-13 * (box.max().cwiseAbs() + box.min().cwiseAbs()).sum();
      for (std::size_t i = 0; i < 13; ++i) {
        const Vector3d d(kCubeDirections[i][0], kCubeDirections[i][1], kCubeDirections[i][2]);
        EXPECT_EQ(floats.max[i], float_up(bounds.max[i]));
        EXPECT_EQ(floats.min[i], float_down(bounds.min[i]));
        EXPECT_NEAR(bounds.max[i], d.dot(support(volume, d)), room)
            << shape_name(volume) << ", " << scale.name << i;
        EXPECT_NEAR(bounds.min[i], d.dot(support(volume, -d)), room)
            << shape_name(volume) << ", " << scale.name << i;
      }
    }
  }
}

TEST(SlabBounds, OfABoxAndOfAKdopAreTheirOwnSlabs) {
  const Aabb box({-1, 2, -3}, {4, 5, 6});
  const SlabBounds<7, double> bounds(box);
  EXPECT_EQ(bounds.max, (std::array<double, 7>{4, 5, 6, 15, 12, 8, 5}));
  EXPECT_EQ(bounds.min, (std::array<double, 7>{-1, 2, -3, -2, -5, -9, -12}));
  Random random(13);
  const Kdop kdop = around(Kdop(KdopSet::dop26()), random.cloud(scales()[1], Span::solid, 50));
  const SlabBounds<13, double> own{AnyVolume(kdop)};
  for (std::size_t i = 0; i < 13; ++i) {
    EXPECT_EQ(own.min[i], kdop.min(i));
    EXPECT_EQ(own.max[i], kdop.max(i));
  }
}

TEST(SlabBounds, MergeHoldsBothAndEmptyIsItsIdentity) {
  const SlabBounds<7, float> a{AnyVolume(Sphere({0, 0, 0}, 1))}, b{AnyVolume(Sphere({3, 1, 0}, 0.5))};
  SlabBounds<7, float> both = a;
  both.merge(b);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(both.min[i], std::min(a.min[i], b.min[i]));
    EXPECT_EQ(both.max[i], std::max(a.max[i], b.max[i]));
  }
  SlabBounds<7, float> other = b, none;
  EXPECT_TRUE(other.merge(a) == both);
  EXPECT_TRUE(none.merge(a) == a);
  none = a;
  EXPECT_TRUE((none.merge(SlabBounds<7, float>()) == a));
}

TEST(SlabBounds, OverlapOnlyWhereNoSlabIsApart) {
  const SlabBounds<7, double> a{Aabb({0, 0, 0}, {1, 1, 1})};
  EXPECT_TRUE(a.overlaps(SlabBounds<7, double>(Aabb({1, 1, 1}, {2, 2, 2}))));
  EXPECT_FALSE(a.overlaps(SlabBounds<7, double>(Aabb({std::nextafter(1, 2), 0, 0}, {2, 2, 2}))));
  // Boxes overlap, the slabs along (1, 1, 1) do not.
  const SlabBounds<7, double> ball{AnyVolume(Sphere({1.5, 1.5, 1.5}, 0.8))};
  EXPECT_FALSE(a.overlaps(ball));
  EXPECT_TRUE((SlabBounds<3, double>(Aabb({0, 0, 0}, {1, 1, 1})))
                  .overlaps(SlabBounds<3, double>(AnyVolume(Sphere({1.5, 1.5, 1.5}, 0.8)))));
  EXPECT_FALSE((SlabBounds<7, double>().overlaps(a)));
  EXPECT_FALSE((SlabBounds<7, double>().overlaps(SlabBounds<7, double>())));
}

TEST(SlabBounds, OfEmptyVolumesAreEmptyAndHoldNothing) {
  for (const AnyVolume& volume : odd_volumes(1)) {
    const SlabBounds<13, float> bounds(volume);
    if (empty(volume)) {
      EXPECT_TRUE(bounds.empty()) << shape_name(volume);
      EXPECT_FALSE(bounds.contains({0, 0, 0}));
    }
  }
  EXPECT_FALSE((SlabBounds<7, float>(Aabb({0, 0, 0}, {1, 1, 1})).contains({0.5, kNan, 0.5})));
}

TEST(SlabBounds, AreInfiniteWherePlanesEncloseNothing) {
  const SlabBounds<7, float> half(Hull({{0, 0, 0}}, {}, {{Vector3d(0, 0, 1), 2.0}}, 0));
  EXPECT_EQ(half.min[2], -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(half.contains({1e30, -1e30, 1}));
}

// All but one direction unbounded.
SlabBounds<13, double> slab(std::size_t i, double min, double max) {
  SlabBounds<13, double> bounds;
  bounds.min.fill(-kInfinity);
  bounds.max.fill(kInfinity);
  bounds.min[i] = min;
  bounds.max[i] = max;
  return bounds;
}

TEST(SlabBounds, ContainWhatIsInsideAndRefuseWhatIsOutsideOfAnySlabByMoreThanRounding) {
  Random random(16);
  for (int round = 0; round < 600; ++round) {
    const Vector3d p = random.point(scales()[static_cast<std::size_t>(round) % 2]);
    for (std::size_t i = 0; i < 13; ++i) {
      const Vector3d d(kCubeDirections[i][0], kCubeDirections[i][1], kCubeDirections[i][2]);
      const double up = Expansion().add_dot(d, p).up(), down = Expansion().add_dot(d, p).down();
      const double doubt =
          i < 3
              ? 0
              : 8 * kUnitRoundoff * taxicab3(p);  // the sum's own rounding and the 4 kUnitRoundoff asked for
      ASSERT_TRUE(slab(i, -kInfinity, up).contains(p)) << i;
      ASSERT_TRUE(slab(i, down, kInfinity).contains(p)) << i;
      ASSERT_FALSE(slab(i, -kInfinity, next_down(down - doubt)).contains(p)) << i;
      ASSERT_FALSE(slab(i, next_up(up + doubt), kInfinity).contains(p)) << i;
    }
  }
}

TEST(SlabBounds, ContainWhatIsOutsideByFourRoundingsOfAnExactSumAndNoFartherPoint) {
  Random random(17);
  for (int round = 0; round < 200; ++round) {
    const Vector3d p = (8 * random.vector(1)).array().round() / 8;
    for (std::size_t i = 3; i < 13; ++i) {
      const double s = dot3(kCubeDirections[i], p), doubt = 4 * kUnitRoundoff * taxicab3(p);
      ASSERT_TRUE(slab(i, -kInfinity, s - doubt).contains(p)) << i;
      ASSERT_TRUE(slab(i, s + doubt, kInfinity).contains(p)) << i;
      ASSERT_FALSE(slab(i, -kInfinity, next_down(s - doubt)).contains(p)) << i;
      ASSERT_FALSE(slab(i, next_up(s + doubt), kInfinity).contains(p)) << i;
    }
  }
}

TEST(SlabBounds, AreEmptyOnlyWhereNothingWasBoundedAndEqualOnlyIfAllNumbersAre) {
  for (const Aabb& box :
       {Aabb({0, 5, 9}, {1, 6, 10}), Aabb({9, 5, 0}, {10, 6, 1}), Aabb({2, 2, 2}, {2, 2, 2})})
    EXPECT_FALSE((SlabBounds<7, float>(box).empty()));
  EXPECT_TRUE((SlabBounds<7, float>().empty()));
  const SlabBounds<3, double> a{Aabb({0, 0, 0}, {1, 1, 1})};
  EXPECT_FALSE((a == SlabBounds<3, double>(Aabb({0, 0, 0}, {1, 1, 2}))));
  EXPECT_FALSE((a == SlabBounds<3, double>(Aabb({0, -1, 0}, {1, 1, 1}))));
  EXPECT_TRUE((a == SlabBounds<3, double>(Aabb({0, 0, 0}, {1, 1, 1}))));
}

// Merged in any order they are the same bits.
template <typename T>
void expect_no_negative_zero() {
  for (const Aabb& box : {Aabb({0, 0, 0}, {0, 0, 0}), Aabb({0, 0, 0}, {1, 1, 1}),
                          Aabb({-1, -1, -1}, {0, 0, 0}), Aabb({-1, -1, -1}, {-1e-50, -1e-50, -1e-50})}) {
    const SlabBounds<13, T> bounds(box);
    for (std::size_t i = 0; i < 13; ++i) {
      EXPECT_FALSE(bounds.min[i] == 0 && std::signbit(bounds.min[i])) << i;
      EXPECT_FALSE(bounds.max[i] == 0 && std::signbit(bounds.max[i])) << i;
    }
  }
}
TEST(SlabBounds, HoldNoNegativeZero) {
  expect_no_negative_zero<float>();
  expect_no_negative_zero<double>();
}

}  // namespace
}  // namespace pcl_bv
