// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// What trees are made of: the order of their items, and the boxes around them.

#include "tree_build.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "box_levels.h"
#include "clouds.h"
#include "each_point.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

template <typename T>
using Items = std::vector<PositionedItem<T>>;

template <typename T>
Items<T> items_of(const test::TestCloud<T>& cloud) {
  Items<T> items;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    PositionedItem<T> item;
    load_point(cloud.view(), i, item.position);
    item.index = static_cast<std::int32_t>(i);
    if (is_valid({item.position[0], item.position[1], item.position[2]})) items.push_back(item);
  }
  return items;
}

// Clouds in which one bin has most of the items, or many cuts go through equal coordinates.
template <typename T>
std::vector<test::TestCloud<T>> clouds_to_order() {
  std::vector<test::TestCloud<T>> clouds = test::nasty_clouds<T>();
  for (const std::size_t n : {16, 64, 65, 256, 257, 4096, 4097, 70'000})
    clouds.push_back(test::gaussian<T>(n, n));
  test::TestCloud<T> coarse = test::gaussian<T>(9000, 50, 2), outlier = test::gaussian<T>(5000, 51);
  coarse.name = "few coordinates";
  for (T& x : coarse.xyz)
    x = std::round(x);
  outlier.name = "one bin has all but one";
  outlier.xyz[1] = T(1e7);
  clouds.push_back(coarse);
  clouds.push_back(outlier);
  return clouds;
}

// Sorts each run along the longest side of the box around it, and appends the numbers of the items in each
// run that is not cut, ascending.
template <typename T>
void order_by_sorting(Items<T>& items, std::size_t begin, std::size_t end,
                      std::vector<std::vector<std::int64_t>>& leaves) {
  const auto first = items.begin() + static_cast<std::ptrdiff_t>(begin),
             last = items.begin() + static_cast<std::ptrdiff_t>(end);
  std::size_t longest = 0;
  double length = 0;
  for (std::size_t axis = 0; axis < 3 && begin < end; ++axis) {
    const auto [low, high] = std::minmax_element(
        first, last, [axis](const auto& a, const auto& b) { return a.position[axis] < b.position[axis]; });
    const double side = static_cast<double>(high->position[axis]) - static_cast<double>(low->position[axis]);
    if (side > length) longest = axis;
    length = std::max(length, side);
  }
  const std::size_t count = end - begin;
  if (count <= 16 || length == 0) {
    std::vector<std::int64_t> numbers;
    std::transform(first, last, std::back_inserter(numbers), [](const auto& item) { return item.index; });
    std::sort(numbers.begin(), numbers.end());
    leaves.push_back(numbers);
    return;
  }
  std::sort(first, last, [longest](const auto& a, const auto& b) {
    return std::pair(a.position[longest], a.index) < std::pair(b.position[longest], b.index);
  });
  std::size_t unit = 16;
  while (16 * unit < count)
    unit *= 16;
  const std::size_t units = (count + unit - 1) / unit, parts = std::min<std::size_t>(4, units);
  for (std::size_t p = 0; p < parts; ++p)
    order_by_sorting(items, begin + units * p / parts * unit,
                     p + 1 == parts ? end : begin + units * (p + 1) / parts * unit, leaves);
}

template <typename T>
class TreeBuildOf : public ::testing::Test {};
using ScalarTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TreeBuildOf, ScalarTypes);

TYPED_TEST(TreeBuildOf, OrdersItemsAsSortingAlongLongestSidesDoes) {
  for (const auto& cloud : clouds_to_order<TypeParam>()) {
    SCOPED_TRACE(cloud.name);
    Items<TypeParam> items = items_of(cloud);
    SpatialOrder<TypeParam> order;
    std::copy(items.begin(), items.end(), order.reset(items.size()));
    order.sort(items.size(), Serial{});
    std::vector<std::vector<std::int64_t>> leaves;
    order_by_sorting(items, 0, items.size(), leaves);
    std::size_t place = 0;
    for (const std::vector<std::int64_t>& leaf : leaves) {
      std::vector<std::int64_t> found;
      for (std::size_t i = 0; i < leaf.size(); ++i)
        found.push_back(order[place++].index);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, leaf) << "before place " << place;
    }
  }
}

// A box around the points of a packet, or of what is below, is no greater than rounding needs.
TYPED_TEST(TreeBuildOf, MakesBoxesThatTouchTheirPointsFromAllSides) {
  for (const auto& cloud : test::nasty_clouds<TypeParam>()) {
    SCOPED_TRACE(cloud.name);
    const PointTree tree(cloud.view());
    const BoxLevels& boxes = packed_tree(tree).boxes;
    const PointView points = packed_tree(tree).view();
    std::size_t width = kTreeWidth;
    for (std::size_t level = 0; level < boxes.levels; ++level, width *= kTreeWidth) {
      for (std::size_t item = 0; item < boxes.child_counts[level]; ++item) {
        Aabb around;
        for (std::size_t i = item * width; i < std::min((item + 1) * width, points.count); ++i) {
          const Coordinates p = load_point(points, i);
          around.extend((Vector3d(p.x, p.y, p.z) - Vector3d(boxes.origin.x, boxes.origin.y, boxes.origin.z)) *
                        boxes.scale);
        }
        const BoxGroup& group = boxes.groups[boxes.first[level] + item / kTreeWidth];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto k = static_cast<Eigen::Index>(axis);
          ASSERT_NEAR(static_cast<double>(group.low[axis][item % kTreeWidth]), around.min()[k], 0x1p-20);
          ASSERT_NEAR(static_cast<double>(group.high[axis][item % kTreeWidth]), around.max()[k], 0x1p-20);
        }
      }
    }
  }
}

TYPED_TEST(TreeBuildOf, NamesNothingWhereAPacketLacksPoints) {
  const auto cloud = test::gaussian<TypeParam>(21, 1);
  PointTree tree(test::gaussian<TypeParam>(32, 2).view());
  tree.assign(cloud.view());
  const std::vector<std::int32_t>& numbers = packed_tree(tree).indices;
  ASSERT_EQ(numbers.size(), 32U);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), -1), 11);
}

TEST(BoxLevels, HaveOneGroupAtTheTopAndSixteenBelowEach) {
  for (const std::size_t items : {1, 16, 17, 256, 257, 4096, 4097, 65'536, 1'000'000}) {
    BoxLevels boxes;
    reset_levels(boxes, items, {{0, 0, 0}, {1, 1, 1}});
    std::size_t below = items, first = 0;
    for (std::size_t level = 0; level < boxes.levels; ++level) {
      EXPECT_EQ(boxes.first[level], first);
      EXPECT_EQ(boxes.child_counts[level], below);
      below = (below + 15) / 16;
      first += below;
    }
    EXPECT_EQ(below, 1U) << items;
    EXPECT_EQ(boxes.groups.size(), first);
  }
}

TEST(BoxLevels, FillTheirFrame) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    double low[3], high[3], half = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = std::pow(10, 5 * uniform(random)) * uniform(random),
                   size = std::pow(10, 5 * uniform(random)) * std::abs(uniform(random));
      low[axis] = at - size;
      high[axis] = at + size;
      half = std::max(half, (high[axis] - low[axis]) / 2);
    }
    BoxLevels boxes;
    reset_levels(boxes, 5, {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}});
    EXPECT_EQ(std::exp2(std::ilogb(boxes.scale)), boxes.scale);
    EXPECT_LE(half * boxes.scale, 1);
    EXPECT_GE(half * boxes.scale, 0.5 * (1 - 0x1p-40));
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(boxes.origin[axis], low[axis] / 2 + high[axis] / 2, 0x1p-40 * half);
  }
}

// The squared radius from which on a ball about the place surely holds a point of a box that touches its
// points.
double projection_lower_bound(const Vector3d& place, const Vector3d& low, const Vector3d& high) {
  const Vector3d near = (place - low).cwiseAbs().cwiseMin((place - high).cwiseAbs()).cwiseAbs2(),
                 far = (place - low).cwiseAbs().cwiseMax((place - high).cwiseAbs()).cwiseAbs2();
  return (far.sum() * Vector3d::Ones() - far + near).minCoeff();
}

TEST(BoxLevels, TellHowLittleABallMayBeThatSurelyHoldsAPoint) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto somewhere = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 300; ++i) {
    BoxLevels boxes;
    const std::size_t items = 1 + static_cast<std::size_t>(i % 16);
    reset_levels(boxes, items, {{-1, -1, -1}, {1, 1, 1}});
    std::vector<Vector3d> low, high;
    double least = kInfinity, found = kInfinity;
    for (std::size_t k = 0; k < items; ++k) {
      const Vector3d a = somewhere(), b = somewhere();
      low.push_back(a.cwiseMin(b));
      high.push_back(a.cwiseMax(b));
      set_item_box(boxes, k, {low[k].x(), low[k].y(), low[k].z()}, {high[k].x(), high[k].y(), high[k].z()});
      for (int side = 0; side < 3; ++side) {
        Vector3d middle = (low[k] + high[k]) / 2;
        middle[side] = low[k][side];
        least = std::min(least, projection_lower_bound(middle, low[k], high[k]));
      }
      for (int place = 0; place < 20; ++place)
        found = std::min(found, projection_lower_bound(somewhere(), low[k], high[k]));
    }
    find_min_side_radii(boxes);
    const double told = static_cast<double>(boxes.min_side_radius[0]) / (boxes.scale * boxes.scale);
    EXPECT_LE(told, found + 1e-5);
    EXPECT_NEAR(told, least, 1e-5);
  }
}

}  // namespace
}  // namespace pcl_bv::detail
