// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "active_cells.h"

#include "brick_grid.h"

namespace pcl_bv::detail {
namespace {

using Keys = std::unordered_set<std::uint64_t>;
using ShareOfKey = std::unordered_map<std::uint64_t, std::uint32_t>;
constexpr std::uint32_t kSeveral = ~std::uint32_t{0};  // as a share

// Cubes of 16 cells a side are searched first: few of them are near other shares.
constexpr int kCubeSide = 16;

std::uint64_t cube_of(std::uint64_t cell) {
  const auto [x, y, z] = BrickGrid::position(cell);
  constexpr int in_cube = kCubeSide - 1;
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
  const Keys all(others.begin(), others.end());
  Keys near;
  for (const std::uint64_t key : keys)
    for_each_around(key, side, [&](std::uint64_t around) {
      if (all.contains(around)) near.insert(key);
    });
  return near;
}

}  // namespace

Keys cells_near_others(const std::vector<std::uint64_t>& cells, const GatherCells& gather) {
  Keys cubes, candidates;
  for (const std::uint64_t cell : cells)
    cubes.insert(cube_of(cell));
  const Keys near_cubes = keys_near(cubes, gather({cubes.begin(), cubes.end()}), kCubeSide);
  for (const std::uint64_t cell : cells)
    if (near_cubes.contains(cube_of(cell))) candidates.insert(cell);
  return keys_near(candidates, gather({candidates.begin(), candidates.end()}), 1);
}

std::unordered_map<std::uint64_t, CellKind> find_active_cells(
    const std::vector<const ClusterShare*>& shares) {
  std::unordered_map<std::uint64_t, CellKind> kinds;
  if (shares.size() < 2) return kinds;
  Keys cubes;  // with all active cells and all cells near them
  for (const std::uint64_t cube :
       keys_near_other_shares(share_of_keys(shares, cube_of, [](std::uint64_t) { return true; }), kCubeSide))
    for_each_around(cube, kCubeSide, [&](std::uint64_t around) { cubes.insert(around); });
  const ShareOfKey share_of_cell = share_of_keys(
      shares, [](std::uint64_t cell) { return cell; },
      [&](std::uint64_t cell) { return cubes.contains(cube_of(cell)); });
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
