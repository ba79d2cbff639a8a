// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The bounds that the answers about pairs rest on, each against points of the volume that are as far along a
// direction as any.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "gjk.h"
#include "half_space_body.h"
#include "pair_volumes.h"

namespace pcl_bv::detail {
namespace {

using detail::PosedShape;
using Eigen::Vector3d;
using testing::dot;
using testing::ExactPoint;
using testing::Form;
using testing::Random;
using testing::Rational;
using testing::Scale;

constexpr unsigned kSeed = 5;

// d . (p - origin) <= support_value_up(d) + radius |d|.
bool holds(const PosedShape& body, const Vector3d& d, const ExactPoint& p) {
  const Rational beyond =
      dot(d, testing::minus(p, testing::exact(body.origin))) - Rational(body.support_value_up(d));
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
  const PosedShape placed(body);
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
    const PosedShape placed(body);
    EXPECT_TRUE(holds(placed, d, e.point));
    const Rational reach = dot(d, testing::minus(e.point, testing::exact(placed.origin)));
    // The points themselves are off by the rounding of their coordinates.
    const double room = 2e-14 * scale.extent + 0x1p-50 * scale.offset;
    EXPECT_LE(placed.support_value_up(d) + placed.radius - static_cast<double>(reach), room);
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
    const ConvexBody moved = ConvexBody(e.volume).transformed(first), both = moved.transformed(second);
    EXPECT_TRUE(holds(PosedShape(moved), turned, once));
    EXPECT_TRUE(holds(PosedShape(both), again, twice));
    EXPECT_GE(PosedShape(both).size * (1 + 1e-15),
              PosedShape(both).support(again).norm());  // what distances by size rest on
  });
}

// Where three planes meet, by Cramer's rule; none where they are not independent.
std::optional<ExactPoint> corner_of(const HullPlane& a, const HullPlane& b, const HullPlane& c) {
  const auto cross = [](const ExactPoint& u, const ExactPoint& v) -> ExactPoint {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const ExactPoint n = testing::exact(a.normal), m = testing::exact(b.normal), l = testing::exact(c.normal);
  const ExactPoint ml = cross(m, l), ln = cross(l, n), nm = cross(n, m);
  const Rational determinant = testing::product(n, ml);
  if (determinant == 0) return std::nullopt;
  ExactPoint corner;
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] =
        (Rational(a.offset) * ml[k] + Rational(b.offset) * ln[k] + Rational(c.offset) * nm[k]) / determinant;
  }
  return corner;
}

// Of all triples of planes.
std::vector<ExactPoint> corners_of(const std::vector<HullPlane>& planes) {
  std::vector<ExactPoint> corners;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        const auto corner = corner_of(planes[i], planes[j], planes[k]);
        const auto holds_it = [&](const HullPlane& p) {
          return dot(p.normal, *corner) <= Rational(p.offset);
        };
        if (corner && std::all_of(planes.begin(), planes.end(), holds_it)) corners.push_back(*corner);
      }
    }
  }
  return corners;
}

// Faces of a round body with many corners are nearly parallel: here by 1, 1e-3 and 1e-5.
TEST(PairBounds, OfHalfSpacesAreThoseOfTheirCorners) {
  Random random(kSeed);
  for (const double width : {1.0, 1e-3, 1e-5}) {
    detail::HalfSpaceBody half_spaces;
    std::vector<HullPlane> planes;  // tangent to the unit ball
    for (int i = 0; i < 18; ++i) {
      const Vector3d axis = (i < 3 ? 1 : -1) * Vector3d::Unit(i % 3);
      planes.push_back({i < 6 ? axis : (Vector3d::UnitZ() + random.vector(width)).normalized(), 1});
      half_spaces.add(planes.back().normal, planes.back().offset, Vector3d::Zero());
    }
    ASSERT_TRUE(half_spaces.add_box(4));
    const std::vector<ExactPoint> corners = corners_of(planes);
    for (int round = 0; round < 50; ++round) {
      const Vector3d d = (Vector3d::UnitZ() + random.vector(width)).normalized();
      const auto nearer = [&](const ExactPoint& p, const ExactPoint& q) { return dot(d, p) < dot(d, q); };
      const ExactPoint best = *std::max_element(corners.begin(), corners.end(), nearer);
      const Vector3d vertex(static_cast<double>(best[0]), static_cast<double>(best[1]),
                            static_cast<double>(best[2]));
      const Rational expected = dot(d, best);
      for (const Vector3d& hint : {vertex, Vector3d(Vector3d::Zero())}) {  // a wrong one costs time only
        const Rational reach(half_spaces.support_value_up(d, hint));
        EXPECT_GE(reach, expected);
        EXPECT_LE(static_cast<double>(reach - expected), hint == vertex ? 1e-14 : 1e-9) << width;
      }
    }
  }
}

// Octahedra |x| / a + |y| / b + |z| / c <= 1, whose box no half-space of theirs shows.
TEST(PairBounds, TheBoxAroundHalfSpacesIsTightWhateverIsGuessed) {
  for (const Vector3d& half : {Vector3d(1, 1, 1), Vector3d(1, 0.25, 4), Vector3d(1e-6, 1, 1e-3)}) {
    for (const double guess : {1.001, 8.0, 1e6}) {
      detail::HalfSpaceBody half_spaces;
      for (int signs = 0; signs < 8; ++signs) {
        const Vector3d n(signs & 1 ? 1 : -1, signs & 2 ? 1 : -1, signs & 4 ? 1 : -1);
        half_spaces.add(n.cwiseQuotient(half), 1, Vector3d::Zero());
      }
      ASSERT_TRUE(half_spaces.add_box(guess * half.maxCoeff()));
      EXPECT_GE(half_spaces.radius_up(), half.norm() * (1 - 1e-15));
      EXPECT_LE(half_spaces.radius_up(), half.norm() * (1 + 1e-9)) << half.transpose() << ", " << guess;
      for (int k = 0; k < 3; ++k) {
        const double reach = half_spaces.support_value_up(Vector3d::Unit(k), Vector3d::Zero());
        EXPECT_GE(reach, half[k]);
        EXPECT_LE(reach, half[k] + 1e-9 * half.maxCoeff()) << half.transpose() << ", " << guess;
      }
    }
  }
}

TEST(PairBounds, NoBoxIsFoundAroundHalfSpacesThatLeaveOneSideOpen) {
  for (int open = 0; open < 6; ++open) {
    detail::HalfSpaceBody half_spaces;
    for (int side = 0; side < 6; ++side) {
      if (side != open) half_spaces.add((side < 3 ? 1 : -1) * Vector3d::Unit(side % 3), 1, Vector3d::Zero());
    }
    EXPECT_FALSE(half_spaces.add_box(4)) << open;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
