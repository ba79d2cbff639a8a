// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A tree answers as if each point were asked, whatever the cloud and however it is run.

#include "pcl_bv/trees/point_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <thread>

#include "allocations.h"
#include "any_volumes.h"
#include "clouds.h"
#include "executions.h"
#include "flush_to_zero.h"
#include "pcl_bv/volumes/pairs.h"

namespace pcl_bv {

bool operator==(const Neighbor& a, const Neighbor& b) {
  return a.index == b.index && a.squared_distance == b.squared_distance;
}

void PrintTo(const Neighbor& neighbor, std::ostream* out) {
  *out << neighbor.index << " at " << neighbor.squared_distance;
}

namespace {

using namespace testing;

// All valid points of a view, one after another: what the tree is judged by.
class EachPoint {
 public:
  explicit EachPoint(const PointView& view) {
    for (std::size_t i = 0; i < view.count; ++i) {
      const Coordinates p = load_point(view, i);
      if (!is_valid(p)) continue;
      places_.emplace_back(p.x, p.y, p.z);
      numbers_.push_back(static_cast<std::int32_t>(view.index(i)));
    }
  }

  std::size_t size() const { return places_.size(); }
  const std::vector<Vector3d>& places() const { return places_; }

  std::vector<Neighbor> near(const Vector3d& place, double limit) const {
    std::vector<Neighbor> found;
    for (std::size_t i = 0; i < size(); ++i) {
      const Vector3d d = places_[i] - place;
      const double square = (d.x() * d.x() + d.y() * d.y()) + d.z() * d.z();
      if (square <= limit) found.push_back({numbers_[i], square});
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  std::vector<std::int32_t> inside(const AnyVolume& volume) const {
    std::vector<std::int32_t> found;
    for (std::size_t i = 0; i < size(); ++i) {
      if (contains(volume, places_[i])) found.push_back(numbers_[i]);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  std::optional<PointHit> first_hit(const Vector3d& origin, const Vector3d& direction, double radius) const {
    std::optional<PointHit> first;
    for (std::size_t i = 0; i < size(); ++i) {
      const auto inside = Sphere(places_[i], radius).intersect(origin, direction);
      if (!inside) continue;
      if (!first || inside->enter < first->t || (inside->enter == first->t && numbers_[i] < first->index))
        first = PointHit{numbers_[i], inside->enter};
    }
    return first;
  }

 private:
  std::vector<Vector3d> places_;
  std::vector<std::int32_t> numbers_;
};

// Points of the cloud, near them, and anywhere about it, with distances from 0 to beyond its size.
class Questions {
 public:
  Questions(const EachPoint& points, std::uint64_t seed) : points_(points), random_(seed) {
    box_ = Aabb(Vector3d::Zero(), Vector3d::Zero());
    if (points.size() > 0) box_ = Aabb();
    for (const Vector3d& p : points.places())
      box_.extend(p);
    size_ = std::max((box_.max() - box_.min()).maxCoeff(), 1e-300);
  }

  Vector3d place() {
    const double size = size_ * std::pow(10.0, uniform(-8, 1));
    const Vector3d step = size * Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (points_.size() == 0 || random_() % 4 == 0) return box_.center() + step;
    const Vector3d& point = points_.places()[random_() % points_.size()];
    return random_() % 4 == 0 ? point : Vector3d(point + step);
  }

  Vector3d direction() {
    Vector3d direction(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (random_() % 3 == 0) direction[static_cast<int>(random_() % 3)] = 0;
    if (random_() % 3 == 0 && points_.size() > 0) return place() - place();
    return std::pow(10.0, uniform(-3, 3)) * direction;
  }

  // Now and then exactly that of a point.
  double distance(const Vector3d& from) {
    if (points_.size() > 0 && random_() % 3 == 0)
      return (points_.places()[random_() % points_.size()] - from).norm();
    return size_ * std::pow(10.0, uniform(-8, 0.5));
  }

  double size() const { return size_; }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  const EachPoint& points_;
  std::mt19937_64 random_;
  Aabb box_;
  double size_ = 0;
};

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
  for (const std::size_t k : {0, 1, 2, 10, 33, 200}) {
    tree.nearest(place, k, found);
    EXPECT_EQ(found, std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size()))));
    tree.nearest(place, k, found, distance);
    EXPECT_EQ(found, std::vector(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(std::min(k, near.size()))));
  }
  const Sphere sphere(place, distance);
  EXPECT_EQ(tree.any_inside(sphere), !points.inside(sphere).empty());
}

void expect_hits_as_each(const PointTree& tree, const EachPoint& points, Questions& questions) {
  const Vector3d origin = questions.place(), direction = questions.direction();
  const double radius = questions.uniform(0, 1) < 0.2 ? 0 : questions.distance(origin) * 0.1;
  const auto hit = tree.first_hit(origin, direction, radius), expected = points.first_hit(origin, direction, radius);
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
  const std::uint64_t seed = 1;
  for (const auto& cloud : test::nasty_clouds<TypeParam>()) {
    SCOPED_TRACE(cloud.name);
    const EachPoint points(cloud.view());
    for (const Isa isa : usable_isas()) {
      SCOPED_TRACE(isa_name(isa));
      const PointTree tree(cloud.view(), {Serial{}, isa});
      EXPECT_EQ(tree.size(), points.size());
      EXPECT_EQ(tree.dropped(), cloud.size() - points.size());
      Questions questions(points, seed);
      for (int i = 0; i < (test::kEmulated ? 5 : 40); ++i)
        expect_near_as_each(tree, points, questions);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TYPED_TEST(PointTreeOf, MeetsFirstWhatTheFirstOfAllPointsIs) {
  for (const auto& cloud : test::nasty_clouds<TypeParam>()) {
    SCOPED_TRACE(cloud.name);
    const EachPoint points(cloud.view());
    const PointTree tree(cloud.view());
    Questions questions(points, 2);
    for (int i = 0; i < 100; ++i)
      expect_hits_as_each(tree, points, questions);
    if (::testing::Test::HasFailure()) return;
  }
}

// Points on the surfaces of all volumes, a few units in the last place from them, and anywhere.
TYPED_TEST(PointTreeOf, ListsTheSamePointsAsContains) {
  Random random(3);
  for (const Scale& scale : scales()) {
    if (sizeof(TypeParam) == 4 && (scale.extent > 1e30 || scale.extent < 1e-30)) continue;
    const std::vector<AnyVolume> volumes = volumes_of_every_kind(random, scale);
    test::TestCloud<TypeParam> cloud;
    for (const AnyVolume& volume : volumes) {
      for (const Vector3d& p : points_about(random, volume, 1e-3 * scale.extent, 40)) {
        for (const double c : p)
          cloud.xyz.push_back(static_cast<TypeParam>(c));
      }
    }
    const EachPoint points(cloud.view());
    for (const Isa isa : usable_isas()) {
      const PointTree tree(cloud.view(), {Serial{}, isa});
      std::size_t some = 0;
      for (const AnyVolume& volume : volumes) {
        const std::vector<std::int32_t> inside = points.inside(volume);
        std::vector<std::int32_t> found = {7};
        tree.all_inside(volume, found);
        ASSERT_EQ(found, inside) << shape_name(volume) << ", " << scale.name << ", " << isa_name(isa);
        EXPECT_EQ(tree.count_inside(volume), inside.size());
        EXPECT_EQ(tree.any_inside(volume), !inside.empty());
        some += !inside.empty() && inside.size() < points.size();
      }
      // Steps of float are half a metre at UTM.
      if (sizeof(TypeParam) == 8 || scale.extent > 1e-3) {
        EXPECT_GT(some, volumes.size() / 2) << scale.name;
      }
    }
  }
}

TEST(PointTree, HasThePointNearestToAVolumeAsIfEachWereAsked) {
  Random random(20);
  for (const Scale& scale : scales()) {
    if (scale.extent < 1e-100 || scale.extent > 1e38) continue;
    test::TestCloud<double> cloud;
    for (int i = 0; i < 500; ++i) {
      const Vector3d p = random.point({"", scale.offset, 6 * scale.extent});
      cloud.xyz.insert(cloud.xyz.end(), p.begin(), p.end());
    }
    const EachPoint points(cloud.view());
    const PointTree tree(cloud.view());
    for (const AnyVolume& volume : volumes_of_every_kind(random, scale)) {
      const ConvexBody body(volume);
      PointDistance expected{-1, kInfinity};
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = distance(body, points.places()[i]);
        if (d < expected.distance) expected = {static_cast<std::int32_t>(i), d};
      }
      const auto found = tree.nearest_to(volume);
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->index, expected.index) << shape_name(volume) << ", " << scale.name;
      EXPECT_EQ(found->distance, expected.distance);
      EXPECT_EQ(tree.nearest_to(volume, expected.distance)->index, expected.index);
      EXPECT_FALSE(expected.distance > 0 && tree.nearest_to(volume, 0.999 * expected.distance));
    }
    EXPECT_FALSE(tree.nearest_to(Sphere()));
  }
}

// Boxes of a tree that is larger than a crossing volume hold or spare whole groups.
TEST(PointTree, ListsTheSamePointsAsContainsInsideLargeVolumes) {
  const auto cloud = test::gaussian<float>(20'000, 4);
  const EachPoint points(cloud.view());
  const PointTree tree(cloud.view());
  Random random(5);
  for (int round = 0; round < 10; ++round) {
    for (const AnyVolume& volume : volumes_of_every_kind(random, {"unit", 0, 2})) {
      std::vector<std::int32_t> found;
      tree.all_inside(volume, found);
      ASSERT_EQ(found, points.inside(volume)) << shape_name(volume);
    }
  }
}

bool same_bytes(const PackedTree& a, const PackedTree& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
  };
  return a.count == b.count && a.boxes.scale == b.boxes.scale && a.boxes.origin == b.boxes.origin &&
         equal(a.boxes.groups, b.boxes.groups) && equal(a.floats, b.floats) && equal(a.doubles, b.doubles) &&
         equal(a.numbers, b.numbers);
}

TYPED_TEST(PointTreeOf, IsTheSameForEveryExecution) {
  const auto cloud = test::gaussian<TypeParam>(test::kEmulated ? 20'000 : 300'000, 6);
  const PointTree serial(cloud.view());
  for (const auto& [name, execution] : test::every_execution())
    EXPECT_TRUE(same_bytes(PointTree(cloud.view(), execution).packed(), serial.packed())) << name;
}

TYPED_TEST(PointTreeOf, HasBoxesThatHoldTheirPointsByExactArithmetic) {
  using test::Rational;
  for (const auto& cloud : test::nasty_clouds<TypeParam>()) {
    const PointTree tree(cloud.view());
    const BoxLevels& boxes = tree.packed().boxes;
    const PointView points = tree.packed().view();
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
  tree.refit(moved.view());
  const EachPoint points(moved.view());
  Questions questions(points, 10);
  for (int i = 0; i < 50; ++i) {
    expect_near_as_each(tree, points, questions);
    expect_hits_as_each(tree, points, questions);
  }
  for (const AnyVolume& volume : {AnyVolume(Sphere(Vector3d::Constant(100), 5)), AnyVolume(Aabb(Vector3d::Constant(0), Vector3d::Constant(300)))}) {
    std::vector<std::int32_t> found;
    tree.all_inside(volume, found);
    EXPECT_EQ(found, points.inside(volume));
    EXPECT_EQ(tree.count_inside(volume), found.size());
  }
  tree.refit(cloud.view());  // and all are there again
  EXPECT_EQ(tree.count_inside(Sphere(Vector3d::Zero(), 100)), 3000U);
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
}  // namespace pcl_bv
