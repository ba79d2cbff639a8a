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

  // Returns how many points of a run are linked to p. May stop counting when at least `needed` are found.
  std::size_t count(const PositionRange& run, const Point<T>& p, std::size_t needed) const {
    const Box<T> at{p, p};
    std::size_t found = 0;
    const auto skip = [&](const Box<T>& box, std::uint32_t points) {
      if (found >= needed || !(min_squared_distance(at, box) < r2)) return true;
      if (!(max_squared_distance(at, box) < r2)) return false;
      found += points;
      return true;
    };
    scratch.boxes.visit(run, p, skip, [&](std::uint32_t begin, std::uint32_t end) {
      const PositionRange part{begin, end};
      found += scratch.columns.count_linked(&part, 1, p, r2, needed);
      return found < needed;
    });
    return found;
  }
};

// Returns whether a point is a core point. Searches other blocks only if too few linked points are found in
// the point's own block. Compares all points of the cells around in columns if they are few. Otherwise takes
// box by box until enough are found.
template <typename T>
bool is_core(const CoreSearch<T>& search, const Point<T>& p, Neighbourhood<T>& near) {
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
    scratch.boxes.visit(
        run, p, [&](const Box<T>& box, std::uint32_t) { return min_squared_distance(at, box) > min_d2; },
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

// Sorts the points of cells with more than `few` points.
template <typename T>
void sort_large_cells(std::uint32_t few, Cells<T>& cells, CoreScratch<T>& scratch) {
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    const PositionRange range{cells.begin[c], cells.begin[c + 1]};
    if (range.end - range.begin <= few) continue;
    scratch.large_cell.clear();
    for (std::uint32_t i = range.begin; i < range.end; ++i)
      scratch.large_cell.push_back({cells.points[i], scratch.number[i]});
    sort_for_boxes(scratch.large_cell.data(), range.begin, range.end);
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const CellPoint<T>& p = scratch.large_cell[i - range.begin];
      cells.points[i] = p.point;
      scratch.number[i] = p.number;
      cells.node[p.number] = i;
    }
  }
}

// Makes the boxes of the core points. A box of no core point is infinitely far from every point.
template <typename T>
void make_core_boxes(const Cells<T>& cells, CoreScratch<T>& scratch) {
  constexpr T largest = std::numeric_limits<T>::max();
  scratch.boxes.make(cells.points.size() / group_size, [&](std::size_t g) {
    const auto core = scratch.core.begin() + static_cast<std::ptrdiff_t>(g * group_size);
    if (std::find(core, core + group_size, std::uint8_t{0}) == core + group_size)
      return scratch.boxes.of_group(g);
    Box<T> box{{largest, largest, largest}, {-largest, -largest, -largest}};
    for (std::size_t i = 0; i < group_size; ++i)
      if (core[static_cast<std::ptrdiff_t>(i)] != 0) box.extend(cells.points[g * group_size + i]);
    return box;
  });
}

template <typename T>
void start_scratch(std::size_t min_points, Cells<T>& cells, CoreScratch<T>& scratch) {
  const std::size_t points = cells.points.size();
  scratch.core.assign(points, 0);
  scratch.label.assign(points, noise);
  scratch.core_cells.resize(cells.blocks.size());
  scratch.cells_with_non_core.resize(cells.blocks.size());
  scratch.number.resize(points);
  for (std::size_t i = 0; i < points; ++i)
    scratch.number[cells.node[i]] = static_cast<std::uint32_t>(i);
  // Cells with fewer points than min_points are tested point by point, so many of them may have to be
  // searched.
  sort_large_cells(min_points > 2 * group_size ? 2 * group_size : few_points, cells, scratch);
  scratch.columns.assign(cells.points);
  scratch.boxes.make(points / group_size,
                     [&](std::size_t g) { return box_of(cells.points.data() + g * group_size, group_size); });
}

}  // namespace

template <typename T, typename Key>
void find_core(const CellGrid& grid, T r2, std::size_t min_points, bool solid, const ParallelPolicy& policy,
               const std::vector<Key>& keys, Cells<T>& cells, CoreScratch<T>& scratch) {
  start_scratch(min_points, cells, scratch);
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
  make_core_boxes(cells, scratch);
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
                          const std::vector<Key>&, Cells<T>&, CoreScratch<T>&);
// NOLINTEND(bugprone-macro-parentheses)
PCL_BV_FIND_CORE(float, std::uint64_t)
PCL_BV_FIND_CORE(float, WideKey)
PCL_BV_FIND_CORE(double, std::uint64_t)
PCL_BV_FIND_CORE(double, WideKey)
#undef PCL_BV_FIND_CORE
template std::uint32_t remove_non_core(Cells<float>&, CoreScratch<float>&);
template std::uint32_t remove_non_core(Cells<double>&, CoreScratch<double>&);

}  // namespace pcl_bv::detail
