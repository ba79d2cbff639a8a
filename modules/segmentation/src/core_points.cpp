// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// If all points of a cell are linked and the cell has at least min_points points, all of them are core points
// without a test. Most cells of a dense cloud are such cells. For points of other cells, the points in nearby
// cells are tested until enough linked points are found.
#include "core_points.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "neighbourhood.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

constexpr std::uint32_t noise = std::numeric_limits<std::uint32_t>::max();

// Number of blocks that a thread takes at a time. Fewer blocks are not worth starting a thread.
constexpr std::size_t blocks_per_part = 256;

// The arguments of find_core(), for all of its steps.
template <typename T>
struct CoreSearch {
  const Cells<T>& cells;
  CoreScratch<T>& scratch;
  T r2;
  std::size_t min_points;
  bool solid;

  // Calls test(begin, end) for the positions of a run, split at multiples of group_size. If the run contains
  // a whole group and skip() is true for the box of the group, the group is skipped. Stops and returns false
  // when test() returns false.
  template <typename Skip, typename Test>
  bool by_group(const PositionRange& run, Skip skip, Test test) const {
    for (std::uint32_t i = run.begin; i < run.end;) {
      const std::uint32_t group_end = (i / group_size + 1) * group_size;
      const std::uint32_t end = std::min(run.end, group_end);
      const bool whole = i + group_size == end;
      if (!(whole && skip(scratch.groups[i / group_size])) && !test(i, end)) return false;
      i = end;
    }
    return true;
  }

  // Returns how many points of a run are linked to p. May stop counting when at least `needed` are found.
  std::size_t count(const PositionRange& run, const Point<T>& p, std::size_t needed) const {
    const Box<T> at{p, p};
    std::size_t found = 0;
    const auto skip = [&](const Box<T>& box) {
      if (!(min_squared_distance(at, box) < r2)) return true;
      if (!(max_squared_distance(at, box) < r2)) return false;
      found += group_size;
      return true;
    };
    by_group(run, skip, [&](std::uint32_t begin, std::uint32_t end) {
      std::uint32_t linked = 0;
      for (std::uint32_t i = begin; i < end; ++i)
        linked += squared_distance(cells.points[i], p) < r2 ? 1 : 0;
      found += linked;
      return found < needed;
    });
    return found;
  }
};

// Returns whether a point is a core point. Searches other blocks only if too few linked points are found in
// the point's own block. Compares all points of the cells around in columns if they are at most 1024. Otherwise
// compares group by group until enough are found.
template <typename T>
bool is_core(const CoreSearch<T>& search, const Point<T>& p, Neighbourhood<T>& near) {
  constexpr std::size_t few_points = 1024;
  std::size_t found = 0;
  for (std::size_t i = 0; found < search.min_points;) {
    if (i == near.size()) near.add_other_blocks();
    if (i == near.size()) return false;
    if (near.points() <= few_points) {
      found += search.scratch.columns.count_linked(&near[i], near.size() - i, p, search.r2,
                                                   search.min_points - found);
      i = near.size();
    } else {
      found += search.count(near[i++], p, search.min_points - found);
    }
  }
  return true;
}

// Returns whether the 27 blocks have fewer than min_points points. Then the middle block has no core point.
template <typename T>
bool has_too_few_points(const CoreSearch<T>& search, const BlocksAround& around) {
  const Cells<T>& cells = search.cells;
  std::size_t points = 0;
  for (const std::uint32_t number : around) {
    if (number == no_block) continue;
    const Block& block = cells.blocks[number];
    points += cells.begin[block.first_cell + count_bits(block.occupied)] - cells.begin[block.first_cell];
    if (points >= search.min_points) return false;
  }
  return true;
}

// Marks the core points of the cells of one block.
template <typename T, typename FindAround>
void mark_core(const CoreSearch<T>& search, std::size_t number, FindAround find_around,
               Neighbourhood<T>& near) {
  const Block& block = search.cells.blocks[number];
  std::vector<std::uint8_t>& core = search.scratch.core;
  const BlocksAround* around = nullptr;
  std::uint64_t core_cells = 0;
  std::uint64_t cells_with_non_core = 0;
  std::uint32_t cell = block.first_cell;
  for (std::uint64_t rest = block.occupied; rest != 0; rest &= rest - 1, ++cell) {
    const PositionRange own{search.cells.begin[cell], search.cells.begin[cell + 1]};
    const std::uint64_t bit = rest & -rest;
    if (search.solid && own.end - own.begin >= search.min_points) {
      std::fill(core.begin() + own.begin, core.begin() + own.end, std::uint8_t{1});
      core_cells |= bit;
      continue;
    }
    if (around == nullptr) {
      around = &find_around();
      if (has_too_few_points(search, *around)) {
        cells_with_non_core = block.occupied;
        break;
      }
    }
    near.start(*around, static_cast<unsigned>(std::countr_zero(rest)));
    if (near.points() < search.min_points) near.add_other_blocks();
    const bool too_few = near.points() < search.min_points;
    for (std::uint32_t i = own.begin; i < own.end; ++i) {
      core[i] = !too_few && is_core(search, search.cells.points[i], near) ? 1 : 0;
      (core[i] != 0 ? core_cells : cells_with_non_core) |= bit;
    }
  }
  search.scratch.core_cells[number] = core_cells;
  search.scratch.cells_with_non_core[number] = cells_with_non_core;
}

// Returns the position of the core point to which the non-core point p belongs, or `noise`.
template <typename T>
std::uint32_t nearest_core(const CoreSearch<T>& search, const Point<T>& p, const Neighbourhood<T>& near) {
  const CoreScratch<T>& scratch = search.scratch;
  const Box<T> at{p, p};
  T min_d2 = search.r2;
  std::uint32_t nearest = noise;
  const auto search_run = [&](const PositionRange& run) {
    search.by_group(
        run, [&](const Box<T>& box) { return min_squared_distance(at, box) > min_d2; },
        [&](std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t i = begin; i < end; ++i) {
            const T d2 = squared_distance(search.cells.points[i], p);
            if (scratch.core[i] == 0 || d2 > min_d2) continue;
            // A tie means that another core point has the same d2, or that d2 is r2. Points at r2 are not
            // linked.
            const bool tie = d2 == min_d2;
            if (tie && (nearest == noise || scratch.number[i] > scratch.number[nearest])) continue;
            min_d2 = d2;
            nearest = i;
          }
          return true;
        });
  };
  for (std::size_t i = 0; i < near.size(); ++i)
    search_run(near[i]);
  return nearest;
}

template <typename T, typename FindAround>
void label_border(const CoreSearch<T>& search, std::size_t number, FindAround find_around,
                  Neighbourhood<T>& near) {
  CoreScratch<T>& scratch = search.scratch;
  if (scratch.cells_with_non_core[number] == 0) return;
  const Block& block = search.cells.blocks[number];
  const BlocksAround& around = find_around();
  const auto has_core = [&](std::uint32_t near_block) {
    return near_block != no_block && scratch.core_cells[near_block] != 0;
  };
  if (std::none_of(around.begin(), around.end(), has_core)) return;
  for (std::uint64_t rest = scratch.cells_with_non_core[number]; rest != 0; rest &= rest - 1) {
    const auto bit = static_cast<unsigned>(std::countr_zero(rest));
    const std::uint32_t cell = block.cell(bit);
    const PositionRange own{search.cells.begin[cell], search.cells.begin[cell + 1]};
    near.start(around, bit, scratch.core_cells.data());
    near.add_other_blocks();
    for (std::uint32_t i = own.begin; i < own.end && near.size() > 0; ++i) {
      if (scratch.core[i] == 0) scratch.label[i] = nearest_core(search, search.cells.points[i], near);
    }
  }
}

template <typename T>
void start_scratch(const Cells<T>& cells, CoreScratch<T>& scratch) {
  const std::size_t points = cells.points.size();
  scratch.core.assign(points, 0);
  scratch.label.assign(points, noise);
  scratch.core_cells.resize(cells.blocks.size());
  scratch.cells_with_non_core.resize(cells.blocks.size());
  scratch.number.resize(points);
  for (std::size_t i = 0; i < points; ++i)
    scratch.number[cells.node[i]] = static_cast<std::uint32_t>(i);
  scratch.columns.assign(cells.points);
  scratch.groups.resize(points / group_size);
  for (std::size_t g = 0; g < scratch.groups.size(); ++g)
    scratch.groups[g] = box_of(cells.points.data() + g * group_size, group_size);
}

}  // namespace

template <typename T, typename Key>
void find_core(const CellGrid& grid, T r2, std::size_t min_points, bool solid, const ParallelPolicy& policy,
               const std::vector<Key>& keys, const Cells<T>& cells, CoreScratch<T>& scratch) {
  start_scratch(cells, scratch);
  if (!(r2 > 0)) return;  // nothing is linked
  const CoreSearch<T> search{cells, scratch, r2, min_points, solid};
  const auto in_parts = [&](auto work) {
    for_each_range(policy, keys.size(), blocks_per_part, [&](std::size_t begin, std::size_t end) {
      BlockRows<Key> rows(grid, keys, begin);
      BlocksAround around{};
      Neighbourhood<T> near(cells);
      for (std::size_t b = begin; b < end; ++b) {
        const auto find_around = [&]() -> const BlocksAround& {
          rows.find(b, around);
          return around;
        };
        work(b, find_around, near);
      }
    });
  };
  in_parts([&](std::size_t b, auto find_around, auto& near) { mark_core(search, b, find_around, near); });
  in_parts([&](std::size_t b, auto find_around, auto& near) { label_border(search, b, find_around, near); });
}

template <typename T>
std::uint32_t remove_non_core(Cells<T>& cells, CoreScratch<T>& scratch) {
  std::uint32_t to = 0;
  std::uint32_t to_cell = 0;
  std::uint32_t begin = 0;
  std::uint32_t cell = 0;
  for (std::size_t b = 0; b < cells.blocks.size(); ++b) {
    const std::uint32_t end_cell = cell + count_bits(cells.blocks[b].occupied);
    cells.blocks[b] = {scratch.core_cells[b], to_cell, false};
    for (; cell < end_cell; ++cell) {
      // Writing begin[to_cell] below overwrites no entry that is still needed, because to_cell <= cell.
      const std::uint32_t end = cells.begin[cell + 1];
      const std::uint32_t first = to;
      for (std::uint32_t i = begin; i < end; ++i) {
        if (scratch.core[i] == 0) continue;
        scratch.label[i] = cells.by_point ? to : to_cell;
        cells.points[to++] = cells.points[i];
      }
      if (to > first) cells.begin[to_cell++] = first;
      begin = end;
    }
  }
  cells.begin.resize(to_cell + 1);
  cells.begin[to_cell] = to;
  cells.points.resize(to);
  const std::uint32_t noise_node = cells.by_point ? to : to_cell;
  for (std::uint32_t& node : cells.node) {
    const std::uint32_t label = scratch.label[node];
    node = scratch.core[node] != 0 ? label : label == noise ? noise_node : scratch.label[label];
  }
  return noise_node;
}

// NOLINTBEGIN(bugprone-macro-parentheses): the arguments are types
#define PCL_BV_FIND_CORE(T, Key)                                                        \
  template void find_core(const CellGrid&, T, std::size_t, bool, const ParallelPolicy&, \
                          const std::vector<Key>&, const Cells<T>&, CoreScratch<T>&);
// NOLINTEND(bugprone-macro-parentheses)
PCL_BV_FIND_CORE(float, std::uint64_t)
PCL_BV_FIND_CORE(float, WideKey)
PCL_BV_FIND_CORE(double, std::uint64_t)
PCL_BV_FIND_CORE(double, WideKey)
#undef PCL_BV_FIND_CORE
template std::uint32_t remove_non_core(Cells<float>&, CoreScratch<float>&);
template std::uint32_t remove_non_core(Cells<double>&, CoreScratch<double>&);

}  // namespace pcl_bv::detail
