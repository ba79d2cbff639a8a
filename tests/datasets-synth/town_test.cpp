// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/synth/town.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace pcl_bv::detail {
namespace {

TownOptions coarse(std::uint64_t seed = 1) {
  return {seed, 20'000, true};
}

TEST(Town, TilesHaveAboutTheirNumberOfPoints) {
  const Town town({});
  std::size_t all = 0;
  for (std::size_t number = 0; number < 64; ++number) {
    const std::size_t count = town.tile(town_tile(number)).size();
    EXPECT_NEAR(static_cast<double>(count), 200'000, 60'000);
    all += count;
  }
  EXPECT_NEAR(static_cast<double>(all) / 64, 200'000, 15'000);
  // Models have more points than that if their sides are only some spacings long.
  const std::size_t few = Town(coarse()).tile({1, 1}).size();
  EXPECT_NEAR(static_cast<double>(few), 24'000, 8'000);
}

TEST(Town, PointsAreInTheirTileAndOnTheirObjects) {
  const Town town(coarse());
  for (const TownTile tile : {TownTile{0, 0}, TownTile{3, 5}, TownTile{310, 2}}) {
    const SynthCloud cloud = town.tile(tile);
    std::map<std::uint32_t, TownObject> objects;
    for (const TownObject& object : town.objects(tile))
      objects[object.id] = object;
    const double west = 100.0 * static_cast<double>(tile.column),
                 south = 100.0 * static_cast<double>(tile.row);
    std::size_t ground = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double x = cloud.xyz[3 * i], y = cloud.xyz[3 * i + 1];
      ASSERT_TRUE(x >= west && x < west + 100 && y >= south && y < south + 100) << x << ' ' << y;
      ASSERT_LT(std::abs(cloud.xyz[3 * i + 2]), 30);
      if (cloud.object[i] == 0) {
        ++ground;
        continue;
      }
      const TownObject& object = objects.at(cloud.object[i]);
      const double rounding = 2e-3;
      ASSERT_GE(x, object.min[0] - rounding);
      ASSERT_LE(x, object.max[0] + rounding);
      ASSERT_GE(y, object.min[1] - rounding);
      ASSERT_LE(y, object.max[1] + rounding);
    }
    EXPECT_GT(ground, cloud.size() / 4);
    EXPECT_GT(objects.size(), 40U);
  }
}

TEST(Town, ObjectsCrossTileBorders) {
  const Town town(coarse());
  const SynthCloud west = town.tile({3, 3}), east = town.tile({4, 3});
  const auto ids = [](const SynthCloud& cloud) {
    return std::set<std::uint32_t>(cloud.object.begin(), cloud.object.end());
  };
  const std::set<std::uint32_t> a = ids(west), b = ids(east);
  std::map<SynthObjectKind, int> shared;
  for (const TownObject& object : town.objects({3, 3}))
    if (a.count(object.id) > 0 && b.count(object.id) > 0) ++shared[object.kind];
  EXPECT_GE(shared.size(), 2U);  // kinds
  int crossing = 0, houses = 0;
  for (std::size_t number = 0; number < 64; ++number)
    for (const TownObject& object : town.objects(town_tile(number))) {
      const bool crosses = std::floor(object.min[0] / 100) != std::floor(object.max[0] / 100) ||
                           std::floor(object.min[1] / 100) != std::floor(object.max[1] / 100);
      crossing += int{crosses};
      houses += int{crosses && object.kind == SynthObjectKind::house};
    }
  EXPECT_GT(crossing, 200);
  EXPECT_GT(houses, 50);
}

TEST(Town, ObjectsAreMoreThanHalfAMetreApart) {
  const Town town(coarse(7));
  const std::vector<TownObject> objects = town.objects({4, 4});
  for (const TownObject& a : objects)
    for (const TownObject& b : objects) {
      // Crowns of parks' trees may be above hedges.
      if (a.id >= b.id || a.kind == SynthObjectKind::tree || b.kind == SynthObjectKind::tree) continue;
      const double x = std::max(a.min[0] - b.max[0], b.min[0] - a.max[0]),
                   y = std::max(a.min[1] - b.max[1], b.min[1] - a.max[1]);
      EXPECT_GT(std::hypot(std::max(x, 0.0), std::max(y, 0.0)), 0.5) << a.id << ' ' << b.id;
    }
}

TEST(Town, TilesAreTheSameForTheSameOptionsAndOtherForAnotherSeed) {
  const Town town(coarse()), same(coarse()), other(coarse(2));
  const SynthCloud tile = town.tile({1, 2});
  EXPECT_EQ(tile.xyz, same.tile({1, 2}).xyz);
  EXPECT_EQ(tile.object, same.tile({1, 2}).object);
  EXPECT_NE(tile.xyz, other.tile({1, 2}).xyz);
}

TEST(Town, WithoutGroundHasTheSamePointsOnObjects) {
  TownOptions options = coarse();
  const SynthCloud all = Town(options).tile({1, 1});
  options.ground = false;
  const SynthCloud objects = Town(options).tile({1, 1});
  const auto ground = static_cast<std::size_t>(std::count(all.object.begin(), all.object.end(), 0U));
  ASSERT_EQ(objects.size(), all.size() - ground);
  EXPECT_TRUE(std::equal(objects.xyz.begin(), objects.xyz.end(),
                         all.xyz.begin() + static_cast<std::ptrdiff_t>(3 * ground)));
}

TEST(Town, TilesOfASquareNumberAreASquare) {
  for (const std::size_t side : {1UL, 2UL, 5UL, 10UL}) {
    std::set<std::pair<std::size_t, std::size_t>> tiles;
    for (std::size_t number = 0; number < side * side; ++number) {
      const TownTile tile = town_tile(number);
      EXPECT_LT(std::max(tile.column, tile.row), side);
      tiles.insert({tile.column, tile.row});
    }
    EXPECT_EQ(tiles.size(), side * side);
  }
  EXPECT_EQ(town_tile(99'999), (TownTile{316, 143}));
  EXPECT_EQ(town_file_name({2, 13}), "002_013.pcd");
}

TEST(Town, IsReadFromItsName) {
  EXPECT_EQ(parse_town("town").tiles, 64U);
  EXPECT_TRUE(parse_town("town").options.ground);
  const TownSequence spec = parse_town("town-objects:9:7:5000");
  EXPECT_EQ(spec.tiles, 9U);
  EXPECT_EQ(spec.options.seed, 7U);
  EXPECT_EQ(spec.options.points_per_tile, 5000U);
  EXPECT_FALSE(spec.options.ground);
  for (const char* bad :
       {"towns", "town:", "town:0", "town:100001", "town:1:x", "town:1:2:999", "town:1:2:3000:4"})
    EXPECT_THROW(parse_town(bad), std::invalid_argument) << bad;
  EXPECT_THROW(Town({1, 10, true}), std::invalid_argument);
}

}  // namespace
}  // namespace pcl_bv::detail
