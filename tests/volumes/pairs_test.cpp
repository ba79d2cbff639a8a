// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What pairs of volumes promise by exact arithmetic: no common point is missed, no distance is too great.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "flush_to_zero.h"
#include "pair_volumes.h"
#include "pcl_bv/volumes/pair_queries.h"

namespace pcl_bv::detail {
namespace {

using Eigen::Vector3d;
using testing::ExactPoint;
using testing::Form;
using testing::Random;
using testing::Rational;
using testing::Scale;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr unsigned kSeed = 7;

// Kdop::extend() and half-spaces of 1e-200 leave the range in which products are exact; volumes of
// 1e99 that of rationals that tests have time for.
std::vector<Scale> scales() {
  return {{"unit", 0, 1},      {"utm", 5e6, 1},   {"utm, 1 mm", 5e6, 1e-3}, {"1e-41", 0, 1e-41},
          {"1e-20", 0, 1e-20}, {"1e20", 0, 1e20}, {"1e-100", 0, 1e-100}};
}

template <typename Check>
void for_all_pairs(const Check& check) {
  for (int i = 0; i < testing::kKinds; ++i) {
    for (int j = 0; j < testing::kKinds; ++j) {
      SCOPED_TRACE(::testing::Message() << shape_name(testing::empty_volume(i)) << " and "
                                        << shape_name(testing::empty_volume(j)));
      check(i, j);
    }
  }
}

void expect_touch(const AnyVolume& a, const AnyVolume& b) {
  EXPECT_TRUE(overlaps(a, b));
  EXPECT_EQ(distance(a, b), 0);
}

TEST(Pairs, ATouchInOnePointIsNeverMissed) {
  Random random(kSeed);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for_all_pairs([&](int i, int j) {
      for (int round = 0; round < 3; ++round) {
        const Vector3d p = random.point(scale), away = random.vector(scale.extent);
        const Form form(random, i), other(random, j);
        const ExactPoint exact = testing::exact(p);
        const AnyVolume a = testing::just_reaching(form, p - away, exact, scale.extent);
        const AnyVolume b = testing::just_reaching(other, p + away, exact, scale.extent);
        expect_touch(a, b);
        expect_touch(a, testing::point_volume(j, p));
        expect_touch(testing::point_volume(j, p), a);
        expect_touch(a, Capsule(p, p + away, 0));
      }
    });
  }
}

TEST(Pairs, NoDistanceExceedsThatOfTwoPoints) {
  Random random(kSeed);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for (const double gap : {1.0, 1e-3, 1e-7, 1e-12}) {
      for_all_pairs([&](int i, int j) {
        const Vector3d p = random.point(scale), away = random.vector(scale.extent);
        const Vector3d q = p + gap * away;
        const Form form(random, i), other(random, j);
        const AnyVolume a = testing::just_reaching(form, p - away, testing::exact(p), scale.extent);
        const AnyVolume b = testing::just_reaching(other, q + away, testing::exact(q), scale.extent);
        const Rational d(distance(a, b));
        EXPECT_LE(d * d, testing::squared_distance(testing::exact(p), testing::exact(q)));
      });
    }
  }
}

TEST(Pairs, OfSpheresAreFartherApartThanNothingByTheirExactDistance) {
  Random random(kSeed);
  for (int round = 0; round < 2000; ++round) {
    const Scale scale = scales()[static_cast<std::size_t>(round) % scales().size()];
    const Sphere a(random.point(scale), random.uniform(0, scale.extent)),
        b(random.point(scale), random.uniform(0, scale.extent));
    const Rational centers =
        testing::squared_distance(testing::exact(a.center()), testing::exact(b.center()));
    const Rational reach = Rational(a.radius()) + Rational(b.radius());
    const Rational d = Rational(distance(a, b));
    if (centers <= reach * reach) {
      EXPECT_TRUE(overlaps(a, b));
    } else {
      EXPECT_LE((d + reach) * (d + reach), d > 0 ? centers : reach * reach);
    }
  }
}

TEST(Pairs, OrderChangesNoBit) {
  Random random(kSeed);
  for_all_pairs([&](int i, int j) {
    for (int round = 0; round < 20; ++round) {
      const AnyVolume a = Form(random, i).volume(random.vector(1), 0.5),
                      b = Form(random, j).volume(random.vector(round % 2 ? 1 : 3), 0.5);
      EXPECT_EQ(distance(a, b), distance(b, a));
      EXPECT_EQ(overlaps(a, b), overlaps(b, a));
      const ConvexBody c(a), d(b);
      EXPECT_EQ(within(c, d, 0.5), within(d, c, 0.5));
    }
  });
}

TEST(Pairs, AreApartExactlyWhereTheirDistanceIsNotZero) {
  Random random(kSeed);
  for_all_pairs([&](int i, int j) {
    for (int round = 0; round < 50; ++round) {
      const AnyVolume a = Form(random, i).volume(random.vector(1), 0.5),
                      b = Form(random, j).volume(random.vector(2), 0.5);
      EXPECT_EQ(overlaps(a, b), distance(a, b) == 0);
      const ConvexBody c(a), d(b);
      EXPECT_EQ(overlaps(a, b), overlaps(c, d));
      EXPECT_EQ(distance(a, b), distance(c, d));
      EXPECT_EQ(within(c, d, 0), overlaps(c, d));
    }
  });
}

TEST(Pairs, WithinIsWhatTheDistanceSays) {
  Random random(kSeed);
  for_all_pairs([&](int i, int j) {
    for (int round = 0; round < 20; ++round) {
      const ConvexBody a(Form(random, i).volume(random.vector(1), 0.5)),
          b(Form(random, j).volume(random.vector(2), 0.5));
      const double d = distance(a, b);
      EXPECT_TRUE(within(a, b, d * (1 + 1e-11) + 1e-12));
      EXPECT_FALSE(within(a, b, d * (1 - 1e-11) - 1e-12));
      EXPECT_FALSE(within(a, b, -1));
    }
  });
}

TEST(Pairs, PowersOfTwoScaleExactly) {
  Random random(kSeed);
  for_all_pairs([&](int i, int j) {
    for (int round = 0; round < 10; ++round) {
      const Form form(random, i), other(random, j);
      const Vector3d at = random.vector(1), there = random.vector(3);
      const double d = distance(form.volume(at, 0.5), other.volume(there, 0.5));
      for (const double unit : {0x1p-300, 0x1p-60, 0x1p60, 0x1p300}) {
        EXPECT_EQ(distance(form.volume(unit * at, unit * 0.5), other.volume(unit * there, unit * 0.5)),
                  unit * d);
      }
    }
  });
}

TEST(Pairs, EmptyOnesMeetNothing) {
  Random random(kSeed);
  for_all_pairs([&](int i, int j) {
    const AnyVolume empty = testing::empty_volume(i), other = Form(random, j).volume({0, 0, 0}, 1);
    for (const AnyVolume& b : {other, testing::empty_volume(j)}) {
      EXPECT_FALSE(overlaps(empty, b));
      EXPECT_FALSE(overlaps(b, empty));
      EXPECT_EQ(distance(empty, b), kInf);
      EXPECT_EQ(distance(b, empty), kInf);
      EXPECT_FALSE(within(ConvexBody(empty), ConvexBody(b), 1e300));
    }
    EXPECT_EQ(distance(ConvexBody(empty), Vector3d(1, 2, 3)), kInf);
    EXPECT_TRUE(ConvexBody(empty).transformed(Eigen::Isometry3d::Identity()).empty());
  });
  EXPECT_TRUE(ConvexBody().empty());
}

TEST(Pairs, AVolumeMeetsItselfAndWhatItHolds) {
  Random random(kSeed);
  for (int i = 0; i < testing::kKinds; ++i) {
    const Form form(random, i);
    for (const Vector3d& at : {Vector3d(0, 0, 0), Vector3d(5e6, -5e6, 5e5)}) {
      expect_touch(form.volume(at, 1), form.volume(at, 1));
      expect_touch(form.volume(at, 1), form.volume(at, 0x1p-20));
      expect_touch(form.volume(at, 0x1p-20), form.volume(at, 1));
    }
  }
}

TEST(Pairs, PointsAreAsFarApartAsTheyAre) {
  for_all_pairs([&](int i, int j) {
    const Vector3d p(1, 2, 3), q(3, 5, 9);  // 7 apart
    EXPECT_NEAR(distance(testing::point_volume(i, p), testing::point_volume(j, q)), 7, 3e-14);
    EXPECT_LE(distance(testing::point_volume(i, p), testing::point_volume(j, q)), 7);
    EXPECT_FALSE(overlaps(testing::point_volume(i, p), testing::point_volume(j, q)));
    expect_touch(testing::point_volume(i, p), testing::point_volume(j, p));
  });
}

TEST(Pairs, HostsThatFlushChangeNoBit) {
  Random random(kSeed);
  for (const double size : {1e-310, 2e-308, 1e-157, 1e-41}) {
    for_all_pairs([&](int i, int j) {
      if (size < 1e-300 && (i == 1 || j == 1 || i == 7 || j == 7)) return;  // normals of such hulls
      const Form form(random, i), other(random, j);
      const AnyVolume a = form.volume(random.vector(size), size),
                      b = other.volume(random.vector(3 * size), size);
      const double d = distance(a, b);
      const bool meet = overlaps(a, b);
      const test::FlushToZero host;
      const double flushed = distance(a, b);
      EXPECT_EQ(std::memcmp(&flushed, &d, sizeof d), 0);
      EXPECT_EQ(overlaps(a, b), meet);
    });
  }
}

TEST(Pairs, PlanesThatLeaveAHullUnboundedMeetEverything) {
  const Hull wedge({{0, 0, 0}}, {}, {{{0, 0, 1}, 0}, {{0, 0, -1}, 1}, {{1, 0, 0}, 1}}, 3);
  expect_touch(wedge, Sphere({100, 100, 100}, 1));
}

TEST(ConvexBody, MovedHoldsTheImageOfEveryPoint) {
  Random random(kSeed);
  for (const Scale& scale : scales()) {
    SCOPED_TRACE(scale.name);
    for_all_pairs([&](int i, int j) {
      const Vector3d p = random.point(scale), away = random.vector(scale.extent);
      const AnyVolume a = testing::just_reaching(Form(random, i), p - away, testing::exact(p), scale.extent);
      Eigen::Isometry3d first = random.isometry(scale.offset + scale.extent), second = random.isometry(1);
      second.translation() = random.vector(scale.offset + scale.extent);
      const ExactPoint once = testing::image(first, testing::exact(p)), twice = testing::image(second, once);
      const auto place = [](const ExactPoint& q) {
        return Vector3d(static_cast<double>(q[0]), static_cast<double>(q[1]), static_cast<double>(q[2]));
      };
      const ConvexBody body(a), moved = body.transformed(first), again = moved.transformed(second);
      const Vector3d there = place(once) + first.linear() * away,
                     farther = place(twice) + second.linear() * first.linear() * away;
      const Form other(random, j);
      EXPECT_TRUE(overlaps(moved, ConvexBody(testing::just_reaching(other, there, once, scale.extent))));
      EXPECT_TRUE(overlaps(again, ConvexBody(testing::just_reaching(other, farther, twice, scale.extent))));
    });
  }
}

TEST(ConvexBody, DistanceOfAPointIsNoneOfItsPoints) {
  Random random(kSeed);
  for (int i = 0; i < testing::kKinds; ++i) {
    const AnyVolume volume = Form(random, i).volume({0, 0, 0}, 1);
    const ConvexBody body(volume);
    for (int round = 0; round < 200; ++round) {
      const Vector3d p = random.vector(3);
      const double d = distance(body, p), expected = distance(volume, p);
      EXPECT_NEAR(d, expected, 1e-13 + 1e-12 * expected);
      EXPECT_EQ(d, distance(volume, Sphere(p, 0)));
      if (testing::inside(volume, testing::exact(p))) {
        EXPECT_EQ(d, 0);
      }
    }
    EXPECT_TRUE(std::isnan(distance(body, Vector3d(std::nan(""), 0, 0))));
    EXPECT_EQ(distance(body, Vector3d(kInf, 0, 0)), kInf);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
