// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bounds that the answers about pairs rest on, each against points of the volume that are as far along a
// direction as any.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "half_spaces.h"
#include "pair_search.h"
#include "pair_volumes.h"

namespace pcl_bv {
namespace {

using Eigen::Vector3d;
using testing::dot;
using testing::ExactPoint;
using testing::Form;
using testing::Random;
using testing::Rational;
using testing::Scale;
using volumes_internal::Placed;

constexpr unsigned kSeed = 5;

// d . (p - origin) <= reach_up(d) + radius |d|.
bool holds(const Placed& body, const Vector3d& d, const ExactPoint& p) {
  const Rational beyond = dot(d, testing::minus(p, testing::exact(body.origin))) - Rational(body.reach_up(d));
  if (beyond <= 0) return true;
  const Rational radius(body.radius);
  return beyond * beyond <= radius * radius * dot(d, testing::exact(d));
}

// A volume and a point of its surface that is, to rounding, the farthest along d.
struct Extreme {
  AnyVolume volume;
  ExactPoint point;
};

Extreme extreme(Random& random, int kind, const Scale& scale, const Vector3d& d) {
  Form form(random, kind);
  form.axes += 3e-13 * Eigen::Matrix3d::Random();
  const Vector3d at = random.point(scale);
  const ConvexBody body(form.volume(at, scale.extent));
  const Placed placed(body);
  const ExactPoint p = testing::exact(Vector3d(placed.origin + (placed.support(d) + placed.radius * d)));
  return {testing::just_reaching(form, at, p, 0.9 * scale.extent), p};
}

std::vector<Scale> scales() {
  return {{"unit", 0, 1}, {"utm", 5e6, 1}, {"1e-20", 0, 1e-20}};
}

template <typename Check>
void for_all_extremes(const Check& check) {
  Random random(kSeed);
  for (const Scale& scale : scales()) {
    for (int kind = 0; kind < testing::kKinds; ++kind) {
      SCOPED_TRACE(::testing::Message() << scale.name << ", " << shape_name(testing::empty_volume(kind)));
      for (int round = 0; round < 60; ++round) {
        const Vector3d d = random.vector(1).normalized();
        check(random, scale, d, extreme(random, kind, scale, d));
      }
    }
  }
}

TEST(PairBounds, ReachIsThatOfTheFarthestPointOrAbove) {
  for_all_extremes([](Random&, const Scale& scale, const Vector3d& d, const Extreme& e) {
    const ConvexBody body(e.volume);
    const Placed placed(body);
    EXPECT_TRUE(holds(placed, d, e.point));
    const Rational reach = dot(d, testing::minus(e.point, testing::exact(placed.origin)));
    // The points themselves are off by the rounding of their coordinates.
    const double room = 2e-14 * scale.extent + 0x1p-50 * scale.offset;
    EXPECT_LE(placed.reach_up(d) + placed.radius - static_cast<double>(reach), room);
  });
}

TEST(PairBounds, HoldForImagesUnderAnyMatrix) {
  for_all_extremes([](Random& random, const Scale& scale, const Vector3d& d, const Extreme& e) {
    Eigen::Isometry3d first = random.isometry(scale.extent), second = random.isometry(scale.offset);
    if (random.uniform(0, 1) < 0.3) first.linear() *= random.uniform(0.5, 2);
    const ExactPoint once = testing::image(first, e.point), twice = testing::image(second, once);
    // Along which the image is the farthest.
    const Vector3d turned = (first.linear().inverse().transpose() * d).normalized(),
                   again = (second.linear() * turned).normalized();
    const ConvexBody moved = ConvexBody(e.volume).moved(first), both = moved.moved(second);
    EXPECT_TRUE(holds(Placed(moved), turned, once));
    EXPECT_TRUE(holds(Placed(both), again, twice));
    EXPECT_GE(Placed(both).size * (1 + 1e-15),
              Placed(both).support(again).norm());  // what distances by size rest on
  });
}

// Neighbouring faces of a round body with many corners are nearly parallel.
TEST(PairBounds, OfManyHalfSpacesAreTightAtEveryCorner) {
  Random random(kSeed);
  for (const double width : {1.0, 1e-3}) {  // of the cap that the normals are in
    volumes_internal::HalfSpaces half_spaces;
    std::vector<HullPlane> planes;
    for (int i = 0; i < 200; ++i) {
      const Vector3d n = i < 6 ? Vector3d((i < 3 ? 1 : -1) * Vector3d::Unit(i % 3))
                               : Vector3d(Vector3d::UnitZ() + random.vector(width)).normalized();
      planes.push_back({n, 1});
      half_spaces.add(n, 1, Vector3d::Zero());
    }
    ASSERT_TRUE(half_spaces.enclose(4));
    for (int round = 0; round < 200; ++round) {
      const Vector3d d = (Vector3d::UnitZ() + random.vector(width)).normalized();
      // No corner is known here: the nearest face does, and all half-spaces then have their turn.
      const double reach = half_spaces.reach_up(d, d);
      EXPECT_GE(reach, 1 - 1e-15);  // all hold the unit ball
      EXPECT_LE(half_spaces.reach_up(d, reach * d), reach + 1e-13);
    }
    for (std::size_t i = 6; i < planes.size(); ++i) {  // tangent planes of the ball
      const double reach = half_spaces.reach_up(planes[i].normal, planes[i].normal);
      EXPECT_GE(reach, 1 - 1e-15);
      EXPECT_LE(reach, 1 + 1e-14);
    }
  }
}

}  // namespace
}  // namespace pcl_bv
