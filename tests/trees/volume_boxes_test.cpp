// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes around volumes: which have one, in what order they lie, and which of them a question visits.

#include "volume_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "any_volumes.h"
#include "vectors.h"

namespace pcl_bv::detail {
namespace {

using namespace testing;

PositionBounds bounds(const Vector3d& low, const Vector3d& high) {
  return {coordinates(low), coordinates(high)};
}

VolumeBoxes boxes_of(const std::vector<PositionBounds>& extents) {
  VolumeBoxes boxes;
  boxes.build(extents, Serial{});
  return boxes;
}

std::vector<std::uint32_t> visited(const VolumeBoxes& boxes, const BoxQuery& query) {
  std::vector<std::uint32_t> numbers;
  EXPECT_FALSE(boxes.visit(query, [&](std::uint32_t number) { return numbers.push_back(number), false; }));
  return numbers;
}

// Whether boxes overlap that are larger by `room`.
bool overlap(const PositionBounds& a, const PositionBounds& b, double room) {
  return (vector(a.low).array() - room <= vector(b.high).array()).all() &&
         (vector(b.low).array() - room <= vector(a.high).array()).all();
}

TEST(VolumeBoxes, ContainedMarginIsOfTheFarthestCoordinate) {
  EXPECT_EQ(contains_margin(Aabb({-1, -7, 0}, {2, 3, 5})), 7 * 0x1p-36 + 0x1p-470);
  EXPECT_EQ(contains_margin(Aabb({-1, -2, 0}, {2, 3, 5})), 5 * 0x1p-36 + 0x1p-470);
  EXPECT_EQ(contains_margin(Aabb({0, 0, 0}, {0, 0, 0})), 0x1p-470);
}

TEST(VolumeBoxes, ExtentsAreBoxesWithTheMarginAndOfEmptyVolumesNone) {
  const Sphere sphere({10, 20, 30}, 2);
  const PositionBounds extent = extent_of(sphere);
  const Vector3d margin = Vector3d::Constant(contains_margin(sphere.aabb()));
  EXPECT_EQ(vector(extent.low), Vector3d(sphere.aabb().min() - margin));
  EXPECT_EQ(vector(extent.high), Vector3d(sphere.aabb().max() + margin));
  EXPECT_GT(extent_of(Sphere()).low.x, extent_of(Sphere()).high.x);
  const Hull hull = cube({1, 2, 3}, 4);
  for (const AnyVolume& volume :
       {AnyVolume(hull), AnyVolume(around(Kdop(KdopSet::dop14()), hull.vertices()))}) {
    const PositionBounds planes = extent_of(volume);
    EXPECT_TRUE((vector(planes.low).array() <= hull.aabb().min().array()).all());
    EXPECT_TRUE((vector(planes.high).array() >= hull.aabb().max().array()).all());
    EXPECT_LT((vector(planes.high) - vector(planes.low)).maxCoeff(), 4 + 1e-9) << shape_name(volume);
  }
}

TEST(VolumeBoxes, OverlappingIsWhatComparisonOfEachSideSays) {
  Random random(41);
  std::size_t touching = 0;
  const auto side = [&] { return static_cast<float>(std::round(random.uniform(-3, 3))); };  // equal ones, too
  for (int round = 0; round < 300; ++round) {
    BoxGroup group;
    BoxQuery query;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < kTreeWidth; ++k) {
        group.low[axis][k] = k == 5 ? std::numeric_limits<float>::infinity() : side();
        group.high[axis][k] = k == 5 ? -group.low[axis][k] : group.low[axis][k] + std::abs(side());
      }
      query.low[axis] = side();
      query.high[axis] = query.low[axis] + std::abs(side());
    }
    std::uint32_t expected = 0;
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      bool all = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
        all = all && group.low[axis][k] <= query.high[axis] && query.low[axis] <= group.high[axis][k];
      expected |= static_cast<std::uint32_t>(all) << k;
    }
    ASSERT_EQ(overlapping(group, query), expected);
    touching += expected != 0;
  }
  EXPECT_GT(touching, 200U);
}

TEST(VolumeBoxes, QueriesReachTheSlackBeyondTheirBox) {
  const VolumeBoxes boxes = boxes_of({bounds({1000, 0, -50}, {1300, 20, 50})});
  EXPECT_EQ(VolumeBoxes::margin(0), 0x1p-20);
  EXPECT_EQ(VolumeBoxes::margin(-3), 0x1p-18);
  for (const double at : {0.0, 1.0, 40.0, 1e7}) {
    const Vector3d low(1000 - at, -at, -20 - at), high(1200 + at, 5 + at, 20 + 2 * at);
    const BoxQuery query = boxes.query(coordinates(low), coordinates(high));
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const double least = boxes.to_frame(low[axis], k), most = boxes.to_frame(high[axis], k);
      EXPECT_NEAR(query.low[axis], least - VolumeBoxes::margin(least), 0.1 * VolumeBoxes::margin(least));
      EXPECT_NEAR(query.high[axis], most + VolumeBoxes::margin(most), 0.1 * VolumeBoxes::margin(most));
    }
  }
  for (const double low : {-1e99, 1e99}) {
    for (const double high : {-1e99, 1e99}) {
      const BoxQuery far = boxes.query({low, low, low}, {high, high, high});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(far.low[axis], std::copysign(0x1p100F, low));
        EXPECT_EQ(far.high[axis], std::copysign(0x1p100F, high));
      }
    }
  }
}

// Extents of which some are nowhere and some everywhere, by each coordinate.
std::vector<PositionBounds> odd_extents(Random& random) {
  std::vector<PositionBounds> extents;
  for (int i = 0; i < 100; ++i) {
    const Vector3d low = Vector3d(500, -70, 3) + random.vector(30);
    extents.push_back(bounds(low, low + random.vector(2).cwiseAbs() * (i % 5)));
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d unit = Vector3d::Unit(axis), one = Vector3d::Ones(), low = vector(extents[3].low),
                   high = vector(extents[4].high);
    const PositionBounds nowhere = bounds(1e6 * one, 2e6 * one - 1.1e6 * unit),
                         open = bounds((unit.array() > 0).select(Vector3d::Constant(-kInfinity), low),
                                       vector(extents[3].high)),
                         far = bounds(vector(extents[4].low), high + 1e101 * unit);
    for (const PositionBounds& extent : {nowhere, open, far})
      extents.insert(extents.begin() + 11 * axis, extent);
  }
  return extents;
}

void expect_visits(const VolumeBoxes& boxes, const std::vector<PositionBounds>& extents, Random& random) {
  std::vector<std::uint32_t> without_box;
  for (std::uint32_t i = 0; i < extents.size(); ++i) {
    if (vector(extents[i].low).minCoeff() < -1e100 || vector(extents[i].high).maxCoeff() > 1e100)
      without_box.push_back(i);
  }
  ASSERT_EQ(without_box.size(), 6U);
  ASSERT_EQ(boxes.without_box(), without_box);
  for (int i = 0; i < 200; ++i) {
    const Vector3d at = Vector3d(500, -70, 3) + random.vector(30);
    const PositionBounds asked = bounds(at, at + Vector3d::Constant(i % 4));
    std::vector<std::uint32_t> found = visited(boxes, boxes.query(asked.low, asked.high));
    ASSERT_TRUE(std::equal(without_box.begin(), without_box.end(), found.begin()));
    std::sort(found.begin(), found.end());
    ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    for (std::uint32_t k = 0; k < extents.size(); ++k) {
      const bool is_found = std::binary_search(found.begin(), found.end(), k);
      ASSERT_GE(is_found, overlap(extents[k], asked, 0)) << k;
      const bool has_no_box = std::binary_search(without_box.begin(), without_box.end(), k);
      ASSERT_LE(is_found, has_no_box || overlap(extents[k], asked, 1e-3)) << k;
    }
  }
}

TEST(VolumeBoxes, VisitWhatOverlapsAndWhatHasNoBoxAndNothingElse) {
  Random random(42);
  const std::vector<PositionBounds> extents = odd_extents(random);
  VolumeBoxes boxes = boxes_of(extents);
  EXPECT_EQ(boxes.size(), extents.size());
  EXPECT_LE(boxes.levels().scale * 32, 1);
  EXPECT_GE(boxes.levels().scale * 70, 1);  // what is nowhere does not count
  ASSERT_NO_FATAL_FAILURE(expect_visits(boxes, extents, random));
  std::vector<PositionBounds> moved = odd_extents(random);
  std::reverse(moved.begin(), moved.end());
  boxes.refit(moved);
  ASSERT_NO_FATAL_FAILURE(expect_visits(boxes, moved, random));
  const BoxQuery query = boxes.query({470, -100, -30}, {530, -40, 33});
  for (const std::size_t last : {1, 6, 7, 50}) {
    std::size_t count = 0;
    EXPECT_TRUE(boxes.visit(query, [&](std::uint32_t) { return ++count == last; }));
    EXPECT_EQ(count, last);
  }
}

// In a row along one axis: whatever their sizes, sixteen whose middles follow one another are in a group.
TEST(VolumeBoxes, LieInTheOrderOfTheirMiddles) {
  Random random(43);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<PositionBounds> extents;
    for (int i = 0; i < 16; ++i)  // nowhere: at the row's beginning
      extents.push_back(bounds({1, 1, 1}, {0, 0, 0}));
    for (int i = 0; i < 240; ++i) {
      Vector3d low = Vector3d::Constant(3), high = Vector3d::Constant(4);
      const double half = std::round(random.uniform(0, 2000));
      low[axis] = 5000 + i - half;
      high[axis] = 5000 + i + half;
      extents.push_back(bounds(low, high));
    }
    std::vector<std::uint32_t> place(256);
    std::iota(place.begin(), place.end(), 0U);
    std::shuffle(place.begin(), place.end(), std::mt19937(5));
    std::vector<PositionBounds> shuffled;
    for (const std::uint32_t i : place)
      shuffled.push_back(extents[i]);
    const VolumeBoxes boxes = boxes_of(shuffled);
    for (std::uint32_t item = 0; item < 256; ++item)
      ASSERT_EQ(place[boxes.volume_index(item)] / 16, item / 16) << axis;
  }
}

}  // namespace
}  // namespace pcl_bv::detail
