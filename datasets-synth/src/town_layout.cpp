// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// A block of the town as a table of rows. A block has a road along its west and its south border and lots, or
// a park, in the rest. All objects of a block lie within it.
#include "town_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pcl_bv::detail {
namespace {

constexpr double kBlockLength = 74, kBlockWidth = 62;  // metres east and north
constexpr double kRoadWidth = 8;
constexpr double kRoadDepth = 0.12;
constexpr std::uint64_t kBlocksPerRow = 512, kSlotsPerBlock = 128;  // 512 blocks are 37 km
constexpr double kParkShare = 0.12;

/// A row of slots in a block, from (x, y) of the block on. Each slot has an object with probability `share`.
struct BlockRow {
  TownModelSet set;
  double x, y;            // middle of the first slot, metres
  int quarters;           // rotation of the model, in quarters of a turn
  double step_x, step_y;  // from one slot to the next
  std::uint64_t slots;
  double jitter_x, jitter_y;  // largest random offsets of an object in its slot
  double share;
  enum Where : std::uint8_t { lots, park, both } where;
};

// All objects are more than 0.5 m apart for all random sizes, so that clustering with a tolerance of 0.5 m
// never joins two objects. Half lengths (along the row) and half widths, metres: houses 6.2 and up to 6,
// hedges 3.1 and 0.35, fences 6.8 and 0.05, low walls 3.3 and 0.15, trees 1.5, trees of parks 4.6, cars 2.6
// and 0.96, posts 0.3. The models' fronts of houses are on the left of their forward axes.
// clang-format off
constexpr std::array block_rows{
    BlockRow{TownModelSet::house,     17.75, 19,   2, 15.5, 0,   4, 0.8, 0.5, 0.85, BlockRow::lots},
    BlockRow{TownModelSet::house,     17.75, 51,   0, 15.5, 0,   4, 0.8, 0.5, 0.85, BlockRow::lots},
    BlockRow{TownModelSet::front,     13.9,  11,   0, 7.75, 0,   8, 0.2, 0,   0.75, BlockRow::both},
    BlockRow{TownModelSet::front,     13.9,  59,   0, 7.75, 0,   8, 0.2, 0,   0.75, BlockRow::both},
    BlockRow{TownModelSet::fence,     17.75, 35,   0, 15.5, 0,   4, 0.2, 0,   0.8,  BlockRow::lots},
    BlockRow{TownModelSet::low_wall,  25.5,  30,   1, 15.5, 0,   3, 0,   0.3, 0.6,  BlockRow::lots},
    BlockRow{TownModelSet::low_wall,  25.5,  40.5, 1, 15.5, 0,   3, 0,   0.3, 0.6,  BlockRow::lots},
    BlockRow{TownModelSet::plant,     17.75, 29.5, 0, 15.5, 0,   4, 4,   1.2, 0.8,  BlockRow::lots},
    BlockRow{TownModelSet::plant,     17.75, 40.5, 0, 15.5, 0,   4, 4,   1.2, 0.8,  BlockRow::lots},
    BlockRow{TownModelSet::park_tree, 17.75, 18,   0, 12.4, 0,   5, 0.5, 0.5, 0.8,  BlockRow::park},
    BlockRow{TownModelSet::park_tree, 17.75, 30,   0, 12.4, 0,   5, 0.5, 0.5, 0.8,  BlockRow::park},
    BlockRow{TownModelSet::park_tree, 17.75, 42,   0, 12.4, 0,   5, 0.5, 0.5, 0.8,  BlockRow::park},
    BlockRow{TownModelSet::car,       14,    1.3,  0, 7.5,  0,   8, 0.9, 0.1, 0.4,  BlockRow::both},
    BlockRow{TownModelSet::car,       14,    6.7,  2, 7.5,  0,   8, 0.9, 0.1, 0.4,  BlockRow::both},
    BlockRow{TownModelSet::car,       1.3,   15,   1, 0,    7.6, 6, 0.1, 0.9, 0.4,  BlockRow::both},
    BlockRow{TownModelSet::car,       6.7,   15,   3, 0,    7.6, 6, 0.1, 0.9, 0.4,  BlockRow::both},
    BlockRow{TownModelSet::lamp_post, 22,    8.7,  0, 37,   0,   2, 0,   0,   1,    BlockRow::both},
    BlockRow{TownModelSet::lamp_post, 38,    61.2, 0, 30,   0,   2, 0,   0,   1,    BlockRow::both},
    BlockRow{TownModelSet::sign_post, 11,    8.9,  0, 0,    0,   1, 0.3, 0,   0.7,  BlockRow::both},
    BlockRow{TownModelSet::sign_post, 8.9,   34,   1, 0,    0,   1, 0,   8,   0.5,  BlockRow::both},
};
// clang-format on

constexpr std::uint64_t slots_of_a_block() {
  std::uint64_t slots = 0;
  for (const BlockRow& row : block_rows)
    slots += row.slots;
  return slots;
}
static_assert(slots_of_a_block() < kSlotsPerBlock);

struct Block {
  std::uint64_t column, row;
};

TownInstance instance_of(const Block& block, std::uint64_t slot, const BlockRow& row, const TownModel& model,
                         SplitMix64& random) {
  constexpr std::array<int, 4> sines{0, 1, 0, -1};
  const auto number = static_cast<double>(slot);
  TownInstance object;
  object.model = &model;
  object.x = kBlockLength * static_cast<double>(block.column) + row.x + number * row.step_x +
             random.uniform(-row.jitter_x, row.jitter_x);
  object.y = kBlockWidth * static_cast<double>(block.row) + row.y + number * row.step_y +
             random.uniform(-row.jitter_y, row.jitter_y);
  object.sine = sines.at(static_cast<std::size_t>(row.quarters));
  object.cosine = sines.at(static_cast<std::size_t>((row.quarters + 1) % 4));
  const Box3& box = model.bounds;
  const auto corner = [&](double x, double y) {
    return Vec3{object.x + object.cosine * x - object.sine * y,
                object.y + object.sine * x + object.cosine * y, 0};
  };
  const Vec3 a = corner(box.lo.x, box.lo.y), b = corner(box.hi.x, box.hi.y);
  constexpr double noise = kTownNoise;
  object.low_x = std::min(a.x, b.x) - noise;
  object.low_y = std::min(a.y, b.y) - noise;
  object.high_x = std::max(a.x, b.x) + noise;
  object.high_y = std::max(a.y, b.y) + noise;
  return object;
}

/// Sets the height and the tilt. Upright objects stand on the lowest corner of their bounds.
void put_on(const TownTerrain& terrain, TownInstance& object) {
  if (object.model->upright) {
    object.z =
        std::min({terrain.hills(object.low_x, object.low_y), terrain.hills(object.low_x, object.high_y),
                  terrain.hills(object.high_x, object.low_y), terrain.hills(object.high_x, object.high_y)});
    return;
  }
  constexpr double d = 0.5;
  object.z = terrain.hills(object.x, object.y) - TownTerrain::road_depth(object.x, object.y);
  object.slope_east =
      (terrain.hills(object.x + d, object.y) - terrain.hills(object.x - d, object.y)) / (2 * d);
  object.slope_north =
      (terrain.hills(object.x, object.y + d) - terrain.hills(object.x, object.y - d)) / (2 * d);
}

bool meets(const TownInstance& object, const TownArea& area) {
  return object.low_x < area.high_x && object.high_x >= area.low_x && object.low_y < area.high_y &&
         object.high_y >= area.low_y;
}

void place_block(std::uint64_t seed, const TownTerrain& terrain, const TownModels& models,
                 const TownArea& area, const Block& block, std::vector<TownInstance>& objects) {
  const std::uint64_t number = block.row * kBlocksPerRow + block.column;
  const BlockRow::Where kind =
      SplitMix64({seed, 1, number}).uniform() < kParkShare ? BlockRow::park : BlockRow::lots;
  std::uint64_t slot_of_block = 0;
  for (const BlockRow& row : block_rows) {
    const std::vector<TownModel>& set = models[static_cast<std::size_t>(row.set)];
    for (std::uint64_t slot = 0; slot < row.slots; ++slot, ++slot_of_block) {
      if (row.where != BlockRow::both && row.where != kind) continue;
      SplitMix64 random({seed, 2, number, slot_of_block});
      if (random.uniform() >= row.share) continue;
      const TownModel& model = set[random.next() % set.size()];
      TownInstance object = instance_of(block, slot, row, model, random);
      object.id = static_cast<std::uint32_t>(number * kSlotsPerBlock + slot_of_block + 1);
      if (!meets(object, area)) continue;
      put_on(terrain, object);
      objects.push_back(object);
    }
  }
}

/// Returns the numbers of the first block that meets [low, high), and of the one after the last.
std::array<std::uint64_t, 2> blocks_between(double low, double high, double size) {
  return {static_cast<std::uint64_t>(low / size), static_cast<std::uint64_t>(std::ceil(high / size))};
}

}  // namespace

TownTerrain::TownTerrain(std::uint64_t seed) {
  SplitMix64 random({seed, 3});
  for (double& phase : phases_)
    phase = random.uniform(0, 2 * std::numbers::pi);
}

double TownTerrain::hills(double x, double y) const {
  return 6 * std::sin(x / 190 + phases_[0]) + 4 * std::sin(y / 150 + phases_[1]) +
         0.8 * std::sin((x + y) / 70 + phases_[2]);
}

double TownTerrain::road_depth(double x, double y) {
  const bool road = x - kBlockLength * std::floor(x / kBlockLength) < kRoadWidth ||
                    y - kBlockWidth * std::floor(y / kBlockWidth) < kRoadWidth;
  return road ? kRoadDepth : 0;
}

std::vector<TownInstance> place_town_objects(std::uint64_t seed, const TownTerrain& terrain,
                                             const TownModels& models, const TownArea& area) {
  std::vector<TownInstance> objects;
  const auto [first_column, end_column] = blocks_between(area.low_x, area.high_x, kBlockLength);
  const auto [first_row, end_row] = blocks_between(area.low_y, area.high_y, kBlockWidth);
  for (std::uint64_t row = first_row; row < end_row; ++row)
    for (std::uint64_t column = first_column; column < end_column; ++column)
      place_block(seed, terrain, models, area, {column, row}, objects);
  return objects;
}

}  // namespace pcl_bv::detail
