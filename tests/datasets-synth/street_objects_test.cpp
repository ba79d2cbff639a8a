// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The objects of the street: where they stand, that their returns are theirs, and that clusters can tell them
// apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "street_fixture.h"

namespace pcl_bv::detail {
namespace {

TEST(StreetObjects, BoxesAreBoxesInRangeInOrderOfTheirIds) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    std::uint32_t previous = 0;
    for (const StreetObject& object : street_sweep(seed).objects) {
      EXPECT_GT(object.id, previous);
      previous = object.id;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_GT(object.half_extents[axis], 0);
        for (std::size_t other = 0; other < 3; ++other) {
          EXPECT_NEAR(dot(object.axes[axis], object.axes[other]), axis == other, 1e-12);
        }
      }
      EXPECT_LT(std::abs(object.center[0]), street_max_range + 10);
    }
  }
}

TEST(StreetObjects, ReturnsLieInTheBoxOfTheirObject) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const auto& [cloud, objects] = street_sweep(seed);
    std::unordered_map<std::uint32_t, const StreetObject*> by_id;
    for (const StreetObject& object : objects)
      by_id[object.id] = &object;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.object[i] == 0) continue;
      ASSERT_TRUE(by_id.contains(cloud.object[i]));
      const StreetObject& object = *by_id[cloud.object[i]];
      const Vector p = from_center(object, point_of(cloud, i));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_LT(std::abs(p[axis]), object.half_extents[axis] + noise_bound)
            << name_of(object.kind) << " ray " << i;
      }
    }
  }
}

TEST(StreetObjects, ANearCarFillsItsBoxFromGroundToRoof) {
  // Boxes are tight: of all cars within 20 m together, returns reach every face but for some centimetres.
  const auto& [cloud, objects] = street_sweep(2);
  Vector reach{};
  for (const StreetObject& object : objects) {
    if (object.kind != SynthObjectKind::car) continue;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.object[i] != object.id || range_of(cloud, i) > 20) continue;
      const Vector p = from_center(object, point_of(cloud, i));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        reach[axis] = std::max(reach[axis], std::abs(p[axis]) - object.half_extents[axis]);
        if (reach[axis] == 0) reach[axis] = std::abs(p[axis]) - object.half_extents[axis];
      }
    }
  }
  for (const double r : reach)
    EXPECT_GT(r, -0.05);
}

TEST(StreetObjects, EveryObjectStandsOnTheGround) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    for (const StreetObject& object : street_sweep(seed).objects) {
      double lowest_gap = 1e9;
      double highest_gap = -1e9;
      for (const unsigned corner : {0u, 1u, 2u, 3u}) {
        const Vector p = corner_of(object, corner);
        const double gap = p[2] - street_ground_height(p[0], p[1]);
        lowest_gap = std::min(lowest_gap, gap);
        highest_gap = std::max(highest_gap, gap);
      }
      EXPECT_NEAR(highest_gap, 0, 0.04) << name_of(object.kind) << ' ' << object.id;
      // Upright houses go into the ground at their upper end by the slope, 5 % of at most 12.4 m.
      EXPECT_GT(lowest_gap, -street_slope * 2 * object.half_extents[0] - 0.04) << name_of(object.kind);
    }
  }
}

struct Extent {
  Vector low, high;
};

Extent extent_of(const StreetObject& object) {
  Extent extent{corner_of(object, 0), corner_of(object, 0)};
  for (unsigned corner = 1; corner < 8; ++corner) {
    const Vector p = corner_of(object, corner);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.low[axis] = std::min(extent.low[axis], p[axis]);
      extent.high[axis] = std::max(extent.high[axis], p[axis]);
    }
  }
  return extent;
}

TEST(StreetObjects, NoTwoOfManyStreetsOverlapOrComeWithinHalfAMetre) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    for (const std::size_t frame : {0u, 37u}) {
      const auto objects = make_street_frame({64, seed}, frame).objects;
      for (std::size_t i = 0; i < objects.size(); ++i) {
        const Extent a = extent_of(objects[i]);
        for (std::size_t j = i + 1; j < objects.size(); ++j) {
          const Extent b = extent_of(objects[j]);
          const double gap_x = std::max(a.low[0] - b.high[0], b.low[0] - a.high[0]);
          const double gap_y = std::max(a.low[1] - b.high[1], b.low[1] - a.high[1]);
          ASSERT_GT(std::max(gap_x, gap_y), 0.5)
              << name_of(objects[i].kind) << ' ' << objects[i].id << " and " << name_of(objects[j].kind)
              << ' ' << objects[j].id << " of frame " << frame;
        }
      }
    }
  }
}

TEST(StreetObjects, TheSensorHasItsPlaceToItself) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    for (const StreetObject& object : make_street_frame({64, seed}, 11).objects) {
      const Vector sensor = from_center(object, {0, 0, 0});
      EXPECT_GT(std::max(std::abs(sensor[0]) - object.half_extents[0],
                         std::abs(sensor[1]) - object.half_extents[1]),
                1.5)
          << name_of(object.kind) << ' ' << object.id;
    }
  }
}

/// Cell of half a metre that a point is in, as a key.
std::int64_t cell_key(std::int64_t x, std::int64_t y, std::int64_t z) {
  return (x * 4096 + y) * 4096 + z;
}

TEST(StreetObjects, ReturnsOfTwoObjectsAreMoreThanHalfAMetreApart) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    const SynthCloud& cloud = street_sweep(seed).cloud;
    std::unordered_multimap<std::int64_t, std::size_t> cells;
    const auto cell = [&](std::size_t i, std::size_t axis) {
      return static_cast<std::int64_t>(std::floor(2 * point_of(cloud, i)[axis]));
    };
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.object[i] == 0) continue;
      for (std::int64_t n = 0; n < 27; ++n) {
        const auto [begin, end] = cells.equal_range(
            cell_key(cell(i, 0) + n % 3 - 1, cell(i, 1) + n / 3 % 3 - 1, cell(i, 2) + n / 9 - 1));
        for (auto other = begin; other != end; ++other) {
          if (cloud.object[other->second] == cloud.object[i]) continue;
          const Vector p = point_of(cloud, i);
          const Vector q = point_of(cloud, other->second);
          ASSERT_GT(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]), 0.5)
              << cloud.object[i] << " and " << cloud.object[other->second];
        }
      }
      cells.emplace(cell_key(cell(i, 0), cell(i, 1), cell(i, 2)), i);
    }
  }
}

TEST(StreetObjects, TheStreetHasItsCarsPeoplePolesHousesAndPlants) {
  for (const std::uint64_t seed : street_seeds) {
    SCOPED_TRACE(seed);
    std::array<int, 7> count{};
    for (const StreetObject& object : street_sweep(seed).objects)
      ++count[static_cast<std::size_t>(object.kind)];
    EXPECT_GE(count[static_cast<std::size_t>(SynthObjectKind::car)], 20);
    EXPECT_LE(count[static_cast<std::size_t>(SynthObjectKind::car)], 50);
    for (const int n : count)
      EXPECT_GE(n, 5);
  }
}

TEST(StreetObjects, NearObjectsAreSeenInSomeFrame) {
  // One may stand behind another for a while, not for the 6 s (48 m) in which the sensor passes it.
  std::unordered_set<std::uint32_t> near;
  std::unordered_set<std::uint32_t> seen;
  for (std::size_t frame = 0; frame < 60; frame += 5) {
    const auto [cloud, objects] = make_street_frame({64'000, 1}, frame);
    seen.insert(cloud.object.begin(), cloud.object.end());
    for (const StreetObject& object : objects) {
      if (frame == 0 && object.center[0] > 0 && object.center[0] < 40 && std::abs(object.center[1]) < 20) {
        near.insert(object.id);
      }
    }
  }
  EXPECT_GT(near.size(), 20u);
  for (const std::uint32_t id : near)
    EXPECT_TRUE(seen.contains(id)) << "object " << id;
}

TEST(StreetObjects, EveryKindHasItsName) {
  EXPECT_EQ(name_of(SynthObjectKind::car), "car");
  EXPECT_EQ(name_of(SynthObjectKind::tree), "tree");
}

}  // namespace
}  // namespace pcl_bv::detail
