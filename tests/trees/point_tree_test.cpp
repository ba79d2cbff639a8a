// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A tree answers as if each point were asked, whatever the cloud and however it is run.

#include "pcl_bv/trees/point_tree.h"
#include "point_tree_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <thread>

#include "allocations.h"
#include "clouds.h"
#include "each_point.h"
#include "executions.h"
#include "flush_to_zero.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

std::vector<Neighbor> sorted_near(const PointTree& tree, const Vector3d& place, double distance) {
  std::vector<Neighbor> found = {{7, 7}};
  tree.near(place, distance, found);
  std::sort(found.begin(), found.end());
  return found;
}

void expect_near_as_each(const PointTree& tree, const EachPoint& points, Questions& questions) {
  const Vector3d place = questions.place();
  const double distance = questions.distance(place);
  const std::vector<Neighbor> near = points.near(place, distance * distance);
  EXPECT_EQ(sorted_near(tree, place, distance), near);
  EXPECT_EQ(tree.nearest(place, distance), near.empty() ? std::nullopt : std::optional(near.front()));
  const std::vector<Neighbor> all = points.near(place, std::numeric_limits<double>::infinity());
  EXPECT_EQ(tree.nearest(place), all.empty() ? std::nullopt : std::optional(all.front()));
  std::vector<Neighbor> found = {{7, 7}};
  for (const std::size_t k : {0, 1, 2, 10, 32, 33, 200}) {
    tree.nearest(place, k, found);
    EXPECT_EQ(found,
              std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size()))));
    tree.nearest(place, k, found, distance);
    EXPECT_EQ(found, std::vector(near.begin(),
                                 near.begin() + static_cast<std::ptrdiff_t>(std::min(k, near.size()))));
  }
  const Sphere sphere(place, distance);
  EXPECT_EQ(tree.any_inside(sphere), !points.inside(sphere).empty());
  EXPECT_EQ(tree.any_near(place, distance), !near.empty());
}

void expect_hits_as_each(const PointTree& tree, const EachPoint& points, Questions& questions) {
  const Vector3d origin = questions.place(), direction = questions.direction();
  const double radius = questions.uniform(0, 1) < 0.2 ? 0 : questions.distance(origin) * 0.1;
  const auto hit = tree.first_hit(origin, direction, radius),
             expected = points.first_hit(origin, direction, radius);
  ASSERT_EQ(hit.has_value(), expected.has_value()) << origin << ", " << direction << ", " << radius;
  if (!hit) return;
  EXPECT_EQ(hit->t, expected->t);
  EXPECT_EQ(hit->index, expected->index);
}

template <typename T>
class PointTreeOf : public ::testing::Test {};
using ScalarTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PointTreeOf, ScalarTypes);

TYPED_TEST(PointTreeOf, FindsWhatIsNearAsIfEachPointWereAsked) {
  for_each_tree<TypeParam>([](const PointTree& tree, const EachPoint& points, const auto& cloud) {
    EXPECT_EQ(tree.size(), points.size());
    EXPECT_EQ(tree.dropped(), cloud.size() - points.size());
    Questions questions(points, 1);
    for (int i = 0; i < (test::kFewCases ? 5 : 40); ++i)
      expect_near_as_each(tree, points, questions);
  });
}

// The times of all points are clamped to the largest double. So the smallest index is the first hit.
TEST(PointTree, MeetsFirstTheSmallestIndexIfTimesOverflow) {
  double p[64][3] = {};
  for (int i = 0; i < 64; ++i)
    p[i][0] = 63 - i;
  for (const Isa isa : usable_isas()) {
    const PointTree tree(PointView::of(p[0], sizeof p[0], 64), {Serial{}, isa});
    const auto hit = tree.first_hit({-1e163, 0, 0}, {1e-147, 0, 0}, 0);
    ASSERT_TRUE(hit) << isa_name(isa);
    EXPECT_EQ(hit->index, 0) << isa_name(isa);
    EXPECT_GT(hit->t, 1e308) << isa_name(isa);
  }
}

// The times of both points are 0. So the point that is reached later is the first hit.
TEST(PointTree, MeetsFirstTheSmallestIndexIfTimesUnderflow) {
  const double p[2][3] = {{1.0001e-20, 0, 0}, {1e-20, 0, 0}};
  for (const Isa isa : usable_isas()) {
    const PointTree tree(PointView::of(p[0], sizeof p[0], 2), {Serial{}, isa});
    const auto slow = tree.first_hit(Vector3d::Zero(), {1, 0, 0}, 1e-26),
               fast = tree.first_hit(Vector3d::Zero(), {1e300, 0, 0}, 1e-26);
    ASSERT_TRUE(slow && fast) << isa_name(isa);
    EXPECT_EQ(slow->index, 1) << isa_name(isa);
    EXPECT_EQ(fast->index, 0) << isa_name(isa);
    EXPECT_EQ(fast->t, 0) << isa_name(isa);
  }
}

TYPED_TEST(PointTreeOf, MeetsFirstWhatTheFirstOfAllPointsIs) {
  for_each_tree<TypeParam>([](const PointTree& tree, const EachPoint& points, const auto&) {
    Questions questions(points, 2);
    for (int i = 0; i < 100; ++i)
      expect_hits_as_each(tree, points, questions);
  });
}

bool same_bytes(const PackedTree& a, const PackedTree& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
  };
  return a.count == b.count && a.boxes.scale == b.boxes.scale && a.boxes.origin == b.boxes.origin &&
         equal(a.boxes.groups, b.boxes.groups) && equal(a.floats, b.floats) && equal(a.doubles, b.doubles) &&
         equal(a.indices, b.indices);
}

TYPED_TEST(PointTreeOf, IsTheSameForEveryExecution) {
  auto cloud = test::gaussian<TypeParam>(test::kEmulated ? 20'000 : 300'000, 6);
  for (std::size_t i = 0; i < cloud.xyz.size(); i += 1 + i / 3)
    cloud.xyz[i] = std::numeric_limits<TypeParam>::quiet_NaN();
  const PointTree serial(cloud.view());
  for (const auto& [name, execution] : test::every_execution())
    EXPECT_TRUE(same_bytes(packed_tree(PointTree(cloud.view(), execution)), packed_tree(serial))) << name;
}

TYPED_TEST(PointTreeOf, HasBoxesThatHoldTheirPointsByExactArithmetic) {
  using test::Rational;
  for (const auto& cloud : test::nasty_clouds<TypeParam>()) {
    const PointTree tree(cloud.view());
    const BoxLevels& boxes = packed_tree(tree).boxes;
    const PointView points = packed_tree(tree).view();
    for (std::size_t i = 0; i < points.count; ++i) {
      const Coordinates p = load_point(points, i);
      std::size_t item = i / kTreeWidth;
      for (std::size_t level = 0; level < boxes.levels; ++level) {
        const BoxGroup& group = boxes.groups[boxes.first[level] + item / kTreeWidth];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Rational place = (Rational(p[axis]) - Rational(boxes.origin[axis])) * Rational(boxes.scale);
          ASSERT_LE(Rational(static_cast<double>(group.low[axis][item % kTreeWidth])), place) << cloud.name;
          ASSERT_GE(Rational(static_cast<double>(group.high[axis][item % kTreeWidth])), place) << cloud.name;
        }
        item /= kTreeWidth;
      }
      ASSERT_EQ(item, 0U);
    }
  }
}

TEST(PointTree, NamesPointsByTheirNumbersInTheCloud) {
  const auto cloud = test::gaussian<float>(500, 7);
  std::vector<std::int32_t> chosen = {400, 3, 3, 77, 499};
  PointView some = cloud.view();
  some.indices = chosen.data();
  some.count = chosen.size();
  const PointTree tree(some);
  std::vector<std::int32_t> found;
  tree.all_inside(Sphere(Vector3d::Zero(), 100), found);
  EXPECT_THAT(found, ::testing::ElementsAre(3, 3, 77, 400, 499));
  const PointTree slice(cloud.view().slice(100, 50));
  slice.all_inside(Sphere(Vector3d::Zero(), 100), found);
  EXPECT_EQ(found.front(), 100);
  EXPECT_EQ(found.back(), 149);
}

TYPED_TEST(PointTreeOf, AnswersForPointsThatMoved) {
  const auto cloud = test::gaussian<TypeParam>(3000, 8);
  auto moved = test::gaussian<TypeParam>(3000, 9, 5, 100);
  PointTree tree(cloud.view());
  moved.xyz[3 * 17] = std::numeric_limits<TypeParam>::quiet_NaN();
  for (std::size_t axis = 0; axis < 3; ++axis)
    moved.xyz[3 * (20 + axis) + axis] = std::numeric_limits<TypeParam>::infinity();
  for (std::size_t packet : {0, 5, 187})  // all that is first in a packet
    moved.xyz[3 * static_cast<std::size_t>(packed_tree(tree).indices[packet * kTreeWidth])] =
        std::numeric_limits<TypeParam>::quiet_NaN();
  tree.refit(moved.view());
  const EachPoint points(moved.view());
  Questions questions(points, 10);
  for (int i = 0; i < 50; ++i) {
    expect_near_as_each(tree, points, questions);
    expect_hits_as_each(tree, points, questions);
  }
  for (const AnyVolume& volume : {AnyVolume(Sphere(Vector3d::Constant(100), 5)),
                                  AnyVolume(Aabb(Vector3d::Constant(0), Vector3d::Constant(300)))}) {
    std::vector<std::int32_t> found;
    tree.all_inside(volume, found);
    EXPECT_EQ(found, points.inside(volume));
    EXPECT_EQ(tree.count_inside(volume), found.size());
  }
  tree.refit(cloud.view());  // and all are there again
  EXPECT_EQ(tree.count_inside(Sphere(Vector3d::Zero(), 100)), 3000U);
}

TEST(PointTree, OfASliceMovesWithItsPoints) {
  const auto cloud = test::gaussian<float>(300, 17), moved = test::gaussian<float>(300, 18);
  PointTree tree(cloud.view().slice(100, 60));
  tree.refit(moved.view().slice(50, 200));
  const EachPoint points(moved.view().slice(100, 60));
  Questions questions(points, 18);
  for (int i = 0; i < 50; ++i)
    expect_near_as_each(tree, points, questions);
}

TEST(PointTree, CopiesAnswerOnTheirOwn) {
  const auto cloud = test::gaussian<float>(300, 19), next = test::gaussian<float>(200, 20);
  PointTree tree(cloud.view()), copy(next.view());
  copy = tree;
  tree = *&tree;
  tree.assign(next.view());
  EXPECT_TRUE(same_bytes(packed_tree(copy), packed_tree(PointTree(cloud.view()))));
  EXPECT_TRUE(same_bytes(packed_tree(tree), packed_tree(PointTree(next.view()))));
  tree = std::move(copy);
  tree.refit(cloud.view());
  EXPECT_TRUE(same_bytes(packed_tree(tree), packed_tree(PointTree(cloud.view()))));
}

TEST(PointTree, IsFoundFromWhereSquaresOfItsUnitLeaveTheRange) {
  const auto cloud = test::gaussian<double>(300, 22, 1e-90);
  for (const Isa isa : usable_isas()) {
    const PointTree tree(cloud.view(), {Serial{}, isa});
    const Vector3d place(1e70, 0, 0);
    EXPECT_TRUE(tree.nearest(place, 1.5e70)) << isa_name(isa);
    EXPECT_TRUE(tree.any_near(place, 1.5e70)) << isa_name(isa);
    EXPECT_FALSE(tree.any_near(place, 0.5e70)) << isa_name(isa);
    EXPECT_TRUE(tree.first_hit(place, {-1, 0, 0}, 1)) << isa_name(isa);
  }
}

TEST(PointTree, RefusesNumbersThatItCannotName) {
  const auto cloud = test::gaussian<float>(2, 21);
  PointView far = cloud.view();
  far.first = 2147483645;
  EXPECT_GE(PointTree(far).nearest(Vector3d::Zero())->index, 2147483645);
  far.first = 2147483646;
  EXPECT_THROW(PointTree{far}, std::invalid_argument);
}

TEST(PointTree, RefusesToMoveToOtherPoints) {
  const auto cloud = test::gaussian<float>(100, 11);
  PointTree tree(cloud.view());
  EXPECT_THROW(tree.refit(cloud.view().slice(0, 99)), std::invalid_argument);
  EXPECT_THROW(tree.refit(cloud.view().slice(1, 99)), std::invalid_argument);
  EXPECT_THROW(tree.refit(test::gaussian<double>(100, 11).view()), std::invalid_argument);
  EXPECT_EQ(tree.nearest(Vector3d::Zero()), PointTree(cloud.view()).nearest(Vector3d::Zero()));
}

TEST(PointTree, OfNoPointsHasNothingNear) {
  for (const PointTree& tree : {PointTree(), PointTree(PointView{})}) {
    std::vector<Neighbor> found = {{7, 7}};
    EXPECT_FALSE(tree.nearest(Vector3d::Zero()));
    tree.nearest(Vector3d::Zero(), 5, found);
    EXPECT_TRUE(found.empty());
    EXPECT_FALSE(tree.any_inside(Sphere(Vector3d::Zero(), 1e90)));
    EXPECT_EQ(tree.count_inside(Aabb(Vector3d::Constant(-1), Vector3d::Constant(1))), 0U);
    EXPECT_FALSE(tree.first_hit(Vector3d::Zero(), Vector3d::UnitX(), 1));
  }
}

TEST(PointTree, AnswersNothingAboutNoPlaceAndNoVolume) {
  const auto cloud = test::gaussian<float>(100, 12);
  const PointTree tree(cloud.view());
  EXPECT_FALSE(tree.nearest({kNan, 0, 0}));
  EXPECT_FALSE(tree.nearest({0, kInfinity, 0}));
  EXPECT_FALSE(tree.any_inside(Sphere()));
  EXPECT_FALSE(tree.any_inside(AnyVolume(Hull())));
  EXPECT_FALSE(tree.first_hit(Vector3d::Zero(), {kNan, 0, 0}, 1));
  EXPECT_THROW(tree.nearest(Vector3d::Zero(), -1.0), std::invalid_argument);
  EXPECT_THROW(tree.first_hit(Vector3d::Zero(), Vector3d::UnitX(), -1), std::invalid_argument);
}

TEST(PointTree, IsRightOnAHostThatFlushesToZero) {
  auto cloud = test::gaussian<float>(300, 13, 1e-41);
  const EachPoint points(cloud.view());
  const test::FlushToZero flushing;
  const PointTree tree(cloud.view());
  const std::vector<Neighbor> near = points.near(points.places()[5], 1);
  EXPECT_EQ(tree.size(), 300U);
  EXPECT_EQ(tree.nearest(points.places()[5])->index, 5);
}

TEST(PointTree, NeedsNoMemoryForTheNextSweep) {
  const auto cloud = test::gaussian<float>(30'000, 14), next = test::gaussian<float>(30'000, 15);
  PointTree tree(cloud.view());
  const std::size_t before = allocations();
  tree.assign(next.view());
  tree.refit(cloud.view());
  EXPECT_EQ(allocations(), before);
}

TEST(PointTree, IsAskedByThreadsSideBySide) {
  const auto cloud = test::gaussian<float>(20'000, 16);
  const PointTree tree(cloud.view());
  std::vector<Neighbor> first, second;
  const auto ask = [&](std::vector<Neighbor>& answers) {
    for (std::size_t i = 0; i < 2000; ++i) {
      const Coordinates p = load_point(cloud.view(), i);
      answers.push_back(*tree.nearest(Vector3d(p.x + 0.01, p.y, p.z)));
    }
  };
  std::thread other(ask, std::ref(first));
  ask(second);
  other.join();
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace pcl_bv::detail
