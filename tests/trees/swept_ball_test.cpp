// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A moving ball is shown all points that it may touch, and few others.

#include "pcl_bv/kernels/swept_ball.h"
#include "point_tree_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "clouds.h"
#include "each_point.h"
#include "executions.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

// Keeps what it is shown, and always says the same distance.
struct Shown final : PacketVisitor {
  explicit Shown(const PointTree& tree, float until)
      : latest(until), points(packed_tree(tree).boxes.child_counts[0] * kTreeWidth) {}

  float visit(std::size_t packet, std::uint32_t bits) override {
    EXPECT_NE(bits, 0U);
    for (std::size_t k = 0; k < kTreeWidth; ++k)
      points[packet * kTreeWidth + k] = (bits >> k & 1U) != 0;
    packets.push_back(packet);
    return latest;
  }

  float latest;
  std::vector<std::size_t> packets;
  std::vector<bool> points;
};

struct Ray {
  Vector3d origin, direction;
  double radius;
};

// The steps after which the ball's centre enters a packet's box that is greater by `pad` on all sides;
// infinity if it never does. In double, whose rounding is far below what the kernel's boxes are
// greater by.
double steps_to_box(const BoxLevels& boxes, std::size_t packet, const SweptBall& ball, double pad) {
  const BoxGroup& group = boxes.groups[packet / kTreeWidth];
  double enter = 0, leave = kInfinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double from = (ball.from[axis] - boxes.origin[axis]) * boxes.scale,
                 step = ball.unit[axis] * boxes.scale / ball.steps_per_distance;
    const double low = static_cast<double>(group.low[axis][packet % kTreeWidth]) - pad - from,
                 high = static_cast<double>(group.high[axis][packet % kTreeWidth]) + pad - from;
    if (step == 0 && (low > 0 || high < 0)) return kInfinity;
    if (step == 0) continue;
    enter = std::max(enter, std::min(low / step, high / step));
    leave = std::min(leave, std::max(low / step, high / step));
  }
  return enter <= leave ? enter : kInfinity;
}

void expect_only_what_is_near(const PointTree& tree, const Ray& ray, const SweptBall& ball,
                              const Shown& shown) {
  const BoxLevels& boxes = packed_tree(tree).boxes;
  const PointView places = packed_tree(tree).view();
  // Squares of longer lengths may be infinite as floats.
  const bool in_range = places.scalar == ScalarType::float64 || ray.radius + ball.offset_bound < 0x1p62;
  for (std::size_t i = 0; i < places.count; ++i) {
    if (!shown.points[i] || !in_range) continue;
    const Vector3d from_origin = vector(load_point(places, i)) - ray.origin;
    ASSERT_LE(from_origin.cross(ray.direction.normalized()).norm(),
              ray.radius * (1 + 1e-9) + 0x1p-17 * ball.offset_bound + 1e-12 * ray.origin.lpNorm<1>() + 2e-19);
  }
  const double size = ball.offset_bound * boxes.scale;
  if (!(size < 0x1p59)) return;
  const double pad = ray.radius * boxes.scale + 0x1p-18 * size, last = static_cast<double>(shown.latest);
  for (std::size_t n = 0; n < shown.packets.size(); ++n) {
    // One is shown before there is a latest distance.
    const double enter = steps_to_box(boxes, shown.packets[n], ball, pad);
    ASSERT_LE(enter, n == 0 ? std::numeric_limits<double>::max() : 1.0001 * last + 0.01 * pad);
  }
}

void expect_all_that_is_touched(const PointTree& tree, const Ray& ray, double until, const Shown& shown) {
  const PointView places = packed_tree(tree).view();
  for (std::size_t i = 0; i < places.count; ++i) {
    const auto inside =
        Sphere(vector(load_point(places, i)), ray.radius).intersect(ray.origin, ray.direction);
    ASSERT_TRUE(!inside || inside->enter >= until || shown.points[i]) << inside->enter;
  }
}

template <typename T>
class SweptBallOf : public ::testing::Test {};
using ScalarTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SweptBallOf, ScalarTypes);

void expect_shown(const PointTree& tree, const Ray& ray, double until) {
  const SweptBall ball(packed_tree(tree).boxes, coordinates(ray.origin), coordinates(ray.direction),
                       ray.radius);
  for (const double end : {kInfinity, until}) {
    Shown shown(tree, end == until ? ball.latest_entry(until * ray.direction.norm())
                                   : std::numeric_limits<float>::max());
    visit_along(tree.isa(), packed_tree(tree), ball, shown);
    ASSERT_NO_FATAL_FAILURE(expect_only_what_is_near(tree, ray, ball, shown));
    ASSERT_NO_FATAL_FAILURE(expect_all_that_is_touched(tree, ray, end, shown));
  }
}

TYPED_TEST(SweptBallOf, IsShownAllThatItTouchesAndOnlyWhatIsNear) {
  for_each_tree<TypeParam>([](const PointTree& tree, const EachPoint& points, const auto&) {
    if (tree.empty()) return;
    Questions questions(points, 1);
    for (int i = 0; i < (test::kFewCases ? 3 : 20); ++i) {
      const Vector3d origin = questions.place(), direction = questions.direction();
      const Ray ray{origin, direction, i % 5 == 0 ? 0 : 0.1 * questions.distance(origin)};
      if (direction.isZero(0)) continue;
      const double until = questions.uniform(0, 1) * questions.size() / direction.norm();
      ASSERT_NO_FATAL_FAILURE(expect_shown(tree, ray, until));
    }
  });
}

// The far coordinate is the radius, and the other one is small: only a margin that grows with every
// coordinate allows for the rounding.
TEST(SweptBall, IsShownAPointThatItTouchesOnlyAtTheEdge) {
  for (int along = 0; along < 3; ++along) {
    for (int away = 0; away < 3; ++away) {
      if (away == along) continue;
      Vector3d p = Vector3d::Zero();
      p[along] = 1;
      p[away] = 100;
      const PointTree tree(PointView::of(p.data(), sizeof p, 1));
      expect_shown(tree, {Vector3d::Zero(), Vector3d::Unit(along), 100}, 2);
    }
  }
}

// Points far from 0 and near the line of a ball that starts near them: the coordinates of the start point
// have more digits than a float, and the digits beyond are needed.
TEST(SweptBall, IsShownPointsFarFromZero) {
  for (const float far : {1e10F, -1e30F, 3e38F}) {
    const float p[3] = {far, far, far};
    for (const Isa isa : usable_isas()) {
      const PointTree tree(PointView::of(p, sizeof p, 1), {Serial{}, isa});
      const Vector3d away = 0x1p-23 * static_cast<double>(far) * Vector3d(1.2, -0.6, 0.4);
      const Vector3d origin = vector(load_point(packed_tree(tree).view(), 0)) + away;
      expect_shown(tree, {origin, -away, 1e-3 * away.norm()}, 2);
    }
  }
}

// Else a greater pad would let through what expect_only_what_is_near() measures by it.
TEST(SweptBall, IsLittleGreaterInTheFrameOfTheBoxes) {
  const auto cloud = test::gaussian<double>(1000, 2, 3, 50);
  const PointTree tree(cloud.view());
  const BoxLevels& boxes = packed_tree(tree).boxes;
  for (const double radius : {0.0, 1e-3, 1.0, 40.0}) {
    for (const double away : {0.0, 10.0, 1e5}) {
      const Vector3d origin = vector(boxes.origin) + Vector3d(-away, 1, 2), direction(1e-7, -40, 3e-20);
      const SweptBall ball(boxes, coordinates(origin), coordinates(direction), radius);
      const double size = (away + 3 + radius) * boxes.scale + 1, r = radius * boxes.scale;
      const double position[3] = {-away * boxes.scale, boxes.scale, 2 * boxes.scale};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double near = static_cast<double>(ball.to_near[axis]) / static_cast<double>(ball.inverse[axis]),
                     far = static_cast<double>(ball.to_far[axis]) / static_cast<double>(ball.inverse[axis]);
        EXPECT_NEAR((near + far) / 2, position[axis], 0x1p-22 * size);
        EXPECT_GE(std::abs(near - far) / 2, r + size * 0x1p-20);
        EXPECT_LE(std::abs(near - far) / 2, r * 1.001 + size * 0x1p-18);
      }
      EXPECT_NEAR(ball.offset_bound * boxes.scale, size, 1e-12 * size);
      EXPECT_EQ(ball.length, 40);
      // Of a step from (0, -2, 0) to (0, -1, 0): -40 is -1.25 * 2^5.
      EXPECT_FLOAT_EQ(ball.inverse[1], -0.8F);
      EXPECT_FLOAT_EQ(ball.inverse[0], 32e7F);
      EXPECT_FLOAT_EQ(ball.inverse[2], 0x1p40F);
      EXPECT_NEAR(ball.unit.y, -1, 1e-15);
      EXPECT_NEAR(ball.unit.x, 1e-7 / 40, 1e-23);
      const auto latest = static_cast<double>(ball.latest_entry(3));
      EXPECT_GE(latest, 3 * boxes.scale / 1.25);
      EXPECT_LE(latest, 3 * boxes.scale / 1.25 * (1 + 0x1p-19));
    }
  }
}

// Expects bounds that hold for what intersect() measures. Returns whether the ball certainly touches the
// point.
bool expect_bounds(const SweptBall& ball, const Ray& ray, const Vector3d& p) {
  const auto inside = Sphere(p, ray.radius).intersect(ray.origin, ray.direction);
  const TouchBounds touch = ball.touch(coordinates(p), kInfinity);
  EXPECT_TRUE(touch.is_possible() || !inside);
  EXPECT_TRUE(inside || touch.max == kInfinity);
  if (!inside) return false;
  const TouchBounds measured = ball.bounds_of_time(inside->enter);
  EXPECT_LE(touch.min, measured.max);
  EXPECT_GE(touch.max, measured.min);
  if (std::isfinite(ball.error)) {
    EXPECT_LE(touch.min, inside->enter * ball.length);
    EXPECT_GE(touch.max, inside->enter * ball.length);
  }
  return touch.max < kInfinity;
}

// Directions of all lengths, and balls that start inside.
TYPED_TEST(SweptBallOf, BoundsTheTouchesOfAllPoints) {
  std::size_t certain = 0, touched = 0;
  for_each_tree<TypeParam>([&](const PointTree& tree, const EachPoint& points, const auto&) {
    if (tree.empty()) return;
    Questions questions(points, 2);
    for (int i = 0; i < (test::kFewCases ? 3 : 20); ++i) {
      const Vector3d origin = questions.place();
      const Vector3d direction = questions.direction() * std::ldexp(1, i % 4 == 0 ? 50 * i - 500 : 0);
      if (direction.isZero(0) || !direction.allFinite()) continue;
      const Ray ray{origin, direction, i % 5 == 0 ? 0 : 0.1 * questions.distance(origin)};
      const SweptBall ball(packed_tree(tree).boxes, coordinates(origin), coordinates(direction), ray.radius);
      for (const Vector3d& p : points.places()) {
        certain += expect_bounds(ball, ray, p) ? 1 : 0;
        touched += Sphere(p, ray.radius).intersect(origin, direction) ? 1 : 0;
        ASSERT_FALSE(::testing::Test::HasFailure()) << p.transpose();
      }
    }
  });
  EXPECT_GT(certain, touched / 4);
  EXPECT_GT(touched, 100U);
}

// The distance from the path equals the radius up to rounding, so no touch is certain.
TEST(SweptBall, BoundsTheTouchesOfPointsAtTheEdgeOfItsPath) {
  const auto cloud = test::gaussian<double>(200, 3, 3, 50);
  const PointTree tree(cloud.view());
  std::size_t touched = 0;
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(-2, 3, 0.5)}) {
    const Vector3d origin = vector(load_point(cloud.view(), 0)) - 20 * direction;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vector3d p = vector(load_point(cloud.view(), i));
      const double from_path = (p - origin).cross(direction.normalized()).norm();
      for (int k = -3; k <= 3; ++k) {
        const Ray ray{origin, direction, from_path * (1 + k * 0x1p-50)};
        const SweptBall ball(packed_tree(tree).boxes, coordinates(origin), coordinates(direction),
                             ray.radius);
        EXPECT_FALSE(expect_bounds(ball, ray, p)) << "point " << i << ", " << k;
        touched += Sphere(p, ray.radius).intersect(origin, direction) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(touched, 1000U);
}

}  // namespace
}  // namespace pcl_bv::detail
