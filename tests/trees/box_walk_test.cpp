// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Walks through boxes of boxes visit what they should, in the order they should, and nothing else.

#include "box_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "box_levels.h"
#include "clouds.h"
#include "pcl_bv/numeric/constants.h"
#include "tree_build.h"
#include "volume_walk.h"

namespace pcl_bv::detail {
namespace {

// Bounds of each box of each group: of items at random, of the others the least below; `of_lacking` of boxes
// that a group lacks.
struct Bounds {
  BoxLevels boxes;
  std::vector<std::array<double, kTreeWidth>> of_group;

  explicit Bounds(std::size_t items, double of_lacking = 0) {
    reset_levels(boxes, items, {{0, 0, 0}, {1, 1, 1}});
    of_group.resize(boxes.groups.size());
    for (auto& group : of_group)
      group.fill(of_lacking);
    std::mt19937 random(51);
    for (std::size_t level = 0; level < boxes.levels; ++level) {
      for (std::size_t i = 0; i < boxes.child_counts[level]; ++i) {
        double& bound = of_group[boxes.first[level] + i / kTreeWidth][i % kTreeWidth];
        bound = random() % 3 == 0 ? kInfinity : static_cast<double>(random() % 1000);
        if (level == 0) continue;
        const auto& below = of_group[boxes.first[level - 1] + i];
        const std::size_t count = std::min(kTreeWidth, boxes.child_counts[level - 1] - i * kTreeWidth);
        bound = *std::min_element(below.begin(), below.begin() + static_cast<std::ptrdiff_t>(count));
      }
    }
  }

  double of(std::size_t item) const { return of_group[item / kTreeWidth][item % kTreeWidth]; }

  template <typename Limit, typename Visit>
  void visit(const Limit& limit, const Visit& visit) const {
    visit_nearest_first(
        boxes, [&](std::size_t group) { return of_group.at(group); }, limit, visit);
  }
};

TEST(BoxWalk, DescendsToTheItemsWithinTheLimitAndToNoOthers) {
  for (const std::size_t items : {0, 1, 15, 16, 17, 256, 1000}) {
    const Bounds bounds(items);
    for (const double limit : {kInfinity, 999.0, 500.0, bounds.boxes.levels > 0 ? bounds.of(0) : 0.0, -1.0}) {
      std::vector<std::size_t> expected, found;
      for (std::size_t i = 0; i < items; ++i) {
        if (bounds.of(i) <= limit && bounds.of(i) < kInfinity) expected.push_back(i);
      }
      bounds.visit([&] { return limit; }, [&](std::size_t item) { found.push_back(item); });
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << items << ", " << limit;
    }
  }
}

TEST(BoxWalk, DescendsAtFirstWhereTheBoundIsLeastAndStopsAtALimitThatFell) {
  const Bounds few(16), many(1000);
  std::vector<double> in_order;
  few.visit([] { return kInfinity; }, [&](std::size_t item) { in_order.push_back(few.of(item)); });
  EXPECT_TRUE(std::is_sorted(in_order.begin(), in_order.end()));
  EXPECT_GT(in_order.size(), 5U);

  double nearest = kInfinity, least = kInfinity;
  for (std::size_t i = 0; i < 1000; ++i)
    least = std::min(least, many.of(i));
  many.visit([&] { return nearest; },
             [&](std::size_t item) {
               EXPECT_EQ(many.of(item), least);
               nearest = many.of(item);
             });
  EXPECT_EQ(nearest, least);
}

TEST(BoxWalk, WalksToThePickedItemsInTheirOrderUntilToldToEnd) {
  const Bounds bounds(1000, kInfinity);
  const auto pick = [&](std::size_t group) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < kTreeWidth; ++k)
      bits |= static_cast<std::uint32_t>(bounds.of_group[group][k] <= 300) << k;
    return bits;
  };
  std::vector<std::size_t> expected, found;
  for (std::size_t i = 0; i < 1000; ++i) {
    if (bounds.of(i) <= 300) expected.push_back(i);
  }
  EXPECT_FALSE(walk(bounds.boxes, pick, [&](std::size_t item) { return found.push_back(item), false; }));
  EXPECT_EQ(found, expected);
  found.clear();
  EXPECT_TRUE(
      walk(bounds.boxes, pick, [&](std::size_t item) { return found.push_back(item), found.size() == 9; }));
  expected.resize(9);
  EXPECT_EQ(found, expected);
  EXPECT_FALSE(walk(Bounds(0).boxes, pick, [](std::size_t) { return true; }));
}

TEST(VolumeWalk, EndsWhereItIsToldToWhetherBoxesAreInsideOrCross) {
  const auto cloud = test::gaussian<float>(3001, 52, 3);
  TreeScratch scratch;
  PackedTree tree;
  build_tree(cloud.view(), Serial{}, scratch, tree);
  const Eigen::Vector3d far(99, 99, 99);
  for (const AnyVolume& volume :
       {AnyVolume(Aabb(-far, far)), AnyVolume(Sphere({0, 0, 0}, 3)), AnyVolume(Sphere())}) {
    std::size_t all = 0, calls = 0, points = 0;
    EXPECT_FALSE(walk_inside(Isa::automatic, tree, volume, [&](std::size_t, std::uint32_t bits) {
      points += static_cast<std::size_t>(std::popcount(bits));
      return ++all, false;
    }));
    EXPECT_LE(points, cloud.size());
    if (std::holds_alternative<Aabb>(volume)) {
      EXPECT_EQ(points, cloud.size());
    }
    EXPECT_EQ(all > 20, !empty(volume));
    for (std::size_t last = 1; last <= all; ++last) {
      calls = 0;
      EXPECT_TRUE(walk_inside(Isa::automatic, tree, volume,
                              [&](std::size_t, std::uint32_t) { return ++calls == last; }));
      EXPECT_EQ(calls, last);
    }
  }
}

}  // namespace
}  // namespace pcl_bv::detail
