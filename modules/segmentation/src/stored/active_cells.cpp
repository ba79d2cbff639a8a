// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "active_cells.h"

#include "brick_grid.h"

namespace pcl_bv::detail {
namespace {

using Keys = std::unordered_set<std::uint64_t>;
using ShareOfKey = std::unordered_map<std::uint64_t, std::uint32_t>;
constexpr std::uint32_t kSeveral = ~std::uint32_t{0};  // as a share

// Cubes of cells are searched first: few of them are near other shares.
constexpr int kCubeSide = 16;

// Returns the key of the first cell of the cube that has a cell. The side is a power of 2.
std::uint64_t cube_of(std::uint64_t cell, int side) {
  const auto [x, y, z] = BrickGrid::position(cell);
  const int in_cube = side - 1;
  return BrickGrid::neighbour(cell, -static_cast<int>(x & in_cube), -static_cast<int>(y & in_cube),
                              -static_cast<int>(z & in_cube));
}

// Calls visit(key) for a cell and those around it.
template <typename Visit>
void for_each_around(std::uint64_t key, int side, const Visit& visit) {
  for (int i = 0; i < 27; ++i)
    visit(BrickGrid::neighbour(key, side * (i % 3 - 1), side * (i / 3 % 3 - 1), side * (i / 9 - 1)));
}

// Returns the share that has points in each cell, or kSeveral. Leaves out cells without is_wanted(cell).
template <typename KeyOf, typename IsWanted>
ShareOfKey share_of_keys(const std::vector<const ClusterShare*>& shares, const KeyOf& key_of,
                         const IsWanted& is_wanted) {
  ShareOfKey share_of_key;
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    std::uint64_t last = ~std::uint64_t{0};  // no cell: a key has 63 bits
    for (const ShareRun& run : shares[s]->runs()) {
      const std::uint64_t key = key_of(run.cell);
      if (key == last || !is_wanted(run.cell)) continue;
      last = key;
      const auto [it, added] = share_of_key.emplace(key, s);
      if (!added && it->second != s) it->second = kSeveral;
    }
  }
  return share_of_key;
}

// Returns the keys that have points of several shares in and around them.
Keys keys_near_other_shares(const ShareOfKey& share_of_key, int side) {
  Keys near;
  for (const auto& [key, share] : share_of_key) {
    bool others = share == kSeveral;
    if (!others)
      for_each_around(key, side, [&, own = share](std::uint64_t around) {
        const auto found = share_of_key.find(around);
        others = others || (found != share_of_key.end() && found->second != own);
      });
    if (others) near.insert(key);
  }
  return near;
}

// Returns the keys that have others in or around them.
Keys keys_near(const Keys& keys, const std::vector<std::uint64_t>& others, int side) {
  Keys near;
  for (const std::uint64_t other : others)
    for_each_around(other, side, [&](std::uint64_t around) {
      if (keys.contains(around)) near.insert(around);
    });
  return near;
}

}  // namespace

Keys cells_near_others(const std::vector<std::uint64_t>& cells, int side, const GatherCells& gather) {
  const int cube_side = kCubeSide * side;
  Keys cubes, candidates;
  for (const std::uint64_t cell : cells)
    cubes.insert(cube_of(cell, cube_side));
  const Keys near_cubes = keys_near(cubes, gather({cubes.begin(), cubes.end()}), cube_side);
  for (const std::uint64_t cell : cells)
    if (near_cubes.contains(cube_of(cell, cube_side))) candidates.insert(cell);
  return keys_near(candidates, gather({candidates.begin(), candidates.end()}), side);
}

std::unordered_map<std::uint64_t, CellKind> find_active_cells(
    const std::vector<const ClusterShare*>& shares) {
  std::unordered_map<std::uint64_t, CellKind> kinds;
  if (shares.size() < 2) return kinds;
  const auto own_cube = [](std::uint64_t cell) { return cube_of(cell, kCubeSide); };
  Keys cubes;  // with all active cells and all cells near them
  for (const std::uint64_t cube :
       keys_near_other_shares(share_of_keys(shares, own_cube, [](std::uint64_t) { return true; }), kCubeSide))
    for_each_around(cube, kCubeSide, [&](std::uint64_t around) { cubes.insert(around); });
  const ShareOfKey share_of_cell = share_of_keys(
      shares, [](std::uint64_t cell) { return cell; },
      [&](std::uint64_t cell) { return cubes.contains(own_cube(cell)); });
  const Keys active = keys_near_other_shares(share_of_cell, 1);
  for (const std::uint64_t cell : active)
    for_each_around(cell, 1, [&](std::uint64_t around) {
      if (share_of_cell.contains(around)) kinds.emplace(around, CellKind::near_active);
    });
  for (const std::uint64_t cell : active)
    kinds[cell] = CellKind::active;
  return kinds;
}

}  // namespace pcl_bv::detail
