// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// First the cells of each block are joined. Then neighbouring blocks, found by a sweep over the sorted keys,
// are joined. After the first step, all cells of a block are mostly in one set. Two such blocks need only one
// comparison if they already have the same root. Otherwise the tests of their cells end at the first link.
#include "join_cells.h"

#include <algorithm>
#include <bit>

#include "neighbours.h"
#include "pcl_bv/parallel/for_each_chunk.h"

namespace pcl_bv::detail {
namespace {

// The arguments of join_cells(), for all of its steps.
template <typename T>
struct JoinContext {
  Cells<T>& cells;
  const std::vector<std::uint8_t>& non_solid;
  UnionFind& sets;
  T r2;

  // Returns the node of a cell's first point.
  std::uint32_t node(std::uint32_t cell) const { return cells.by_point ? cells.begin[cell] : cell; }

  bool linked(std::uint32_t a, std::uint32_t b, LinkScratch<T>& scratch) const {
    return any_link(cells.run(a), cells.run(b), r2, scratch);
  }

  bool is_non_solid(std::uint32_t cell) const { return !non_solid.empty() && non_solid[cell]; }
};

// `a` and `b` are the occupied cells of two blocks. Calls visit(bit in a, bit in b) for each pair of cells
// that are neighbours according to `masks`. Stops and returns true when visit() returns true.
template <typename Visit>
bool visit_pairs(const CellMasks& masks, std::uint64_t a, std::uint64_t b, Visit visit) {
  for (; a != 0; a &= a - 1) {
    const auto from = static_cast<unsigned>(std::countr_zero(a));
    for (std::uint64_t near = masks[from] & b; near != 0; near &= near - 1) {
      if (visit(from, static_cast<unsigned>(std::countr_zero(near)))) return true;
    }
  }
  return false;
}

// Joins the points of two cells, at least one of which is non-solid. `a` and `b` may be the same cell.
template <typename T>
void join_non_solid(const JoinContext<T>& context, std::uint32_t a, std::uint32_t b,
                    LinkScratch<T>& scratch) {
  // Each point of a non-solid cell is a node. Any other cell is one node.
  const auto parts = [&context](std::uint32_t cell) {
    return context.is_non_solid(cell) ? context.cells.run(cell).count : 1;
  };
  const auto part = [&context](std::uint32_t cell, std::size_t i) {
    const PointRun<T> all = context.cells.run(cell);
    return context.is_non_solid(cell) ? PointRun<T>{all.points + i, 1} : all;
  };
  for (std::uint32_t i = 0; i < parts(a); ++i) {
    for (std::uint32_t j = 0; j < (a == b ? i : parts(b)); ++j) {
      const std::uint32_t p = context.node(a) + i;
      const std::uint32_t q = context.node(b) + j;
      if (context.sets.find(p) == context.sets.find(q)) continue;
      if (any_link(part(a, i), part(b, j), context.r2, scratch)) context.sets.unite(p, q);
    }
  }
}

// Joins two cells if any of their points are linked.
template <typename T>
void join_pair(const JoinContext<T>& context, std::uint32_t a, std::uint32_t b, LinkScratch<T>& scratch) {
  if (context.is_non_solid(a) || context.is_non_solid(b)) return join_non_solid(context, a, b, scratch);
  const std::uint32_t p = context.node(a);
  const std::uint32_t q = context.node(b);
  if (context.sets.find(p) != context.sets.find(q) && context.linked(a, b, scratch)) context.sets.unite(p, q);
}

// Tests the cells of a block that are near a cell of `from` according to `masks`. Adds to `reached` the cells
// that are linked to that cell. Returns the added cells.
template <typename T>
std::uint64_t spread(const JoinContext<T>& context, const Block& block, const CellMasks& masks,
                     std::uint64_t from, std::uint64_t& reached, LinkScratch<T>& scratch) {
  std::uint64_t added = 0;
  for (; from != 0; from &= from - 1) {
    const auto bit = static_cast<unsigned>(std::countr_zero(from));
    std::uint64_t candidates = masks[bit] & block.occupied & ~reached;
    if (candidates == 0) continue;
    const std::uint32_t cell = block.cell(bit);
    for (; candidates != 0; candidates &= candidates - 1) {
      const std::uint64_t candidate = candidates & -candidates;
      if (!context.linked(cell, block.cell(static_cast<unsigned>(std::countr_zero(candidate))), scratch))
        continue;
      added |= candidate;
      reached |= candidate;
    }
  }
  return added;
}

// Returns the cells of a block that are connected to the lowest cell of `rest`. Spreads over touching cells
// as far as possible, then over cells two away, until no cell is added.
template <typename T>
std::uint64_t component(const JoinContext<T>& context, const Block& block, std::uint64_t rest,
                        LinkScratch<T>& scratch) {
  // Cells outside `rest`, which belong to earlier components, are treated as reached and not tested again.
  std::uint64_t reached = (rest & -rest) | (block.occupied & ~rest);
  std::uint64_t all = rest & -rest;
  std::uint64_t near = all;
  std::uint64_t far = 0;
  while ((near | far) != 0) {
    std::uint64_t added = 0;
    if (near != 0) {
      added = spread(context, block, within_block.touching, near, reached, scratch);
      far |= near;
    } else {
      added = spread(context, block, within_block.two_away, far, reached, scratch);
      far = 0;
    }
    all |= added;
    near = added;
  }
  return all;
}

// Joins the cells of one block. No other thread uses these cells yet.
template <typename T>
void join_within(const JoinContext<T>& context, Block& block, LinkScratch<T>& scratch) {
  std::uint64_t rest = block.occupied;
  while (rest != 0) {
    const std::uint64_t cells = component(context, block, rest, scratch);
    block.united = cells == block.occupied;
    const std::uint32_t root = context.node(block.cell(static_cast<unsigned>(std::countr_zero(rest))));
    for (std::uint64_t c = cells; c != 0; c &= c - 1) {
      context.sets.set_root(context.node(block.cell(static_cast<unsigned>(std::countr_zero(c)))), root);
    }
    rest &= ~cells;
  }
}

// As join_within(), for nodes that are points: cells may be non-solid. Does not set Block::united.
template <typename T>
void join_within_by_pairs(const JoinContext<T>& context, Block& block, LinkScratch<T>& scratch) {
  for (std::uint32_t i = 0; i < count_bits(block.occupied); ++i) {
    for (std::uint32_t j = 0; j <= i; ++j)
      join_pair(context, block.first_cell + i, block.first_cell + j, scratch);
  }
}

// Joins the cells of two neighbouring blocks.
template <typename T>
void join_between(const JoinContext<T>& context, const TouchingAndNext& masks, const Block& a, const Block& b,
                  LinkScratch<T>& scratch) {
  const auto in_both = [&](auto visit) {
    if (!visit_pairs(masks.touching, a.occupied, b.occupied, visit))
      visit_pairs(masks.two_away, a.occupied, b.occupied, visit);
  };
  if (!a.united || !b.united) {
    in_both([&](unsigned from, unsigned to) {
      join_pair(context, a.cell(from), b.cell(to), scratch);
      return false;
    });
    return;
  }
  const std::uint32_t p = context.node(a.first_cell);
  const std::uint32_t q = context.node(b.first_cell);
  if (context.sets.find(p) == context.sets.find(q)) return;
  in_both([&](unsigned from, unsigned to) {
    if (!context.linked(a.cell(from), b.cell(to), scratch)) return false;
    context.sets.unite(p, q);
    return true;
  });
}

// Returns the key of the first block in a row of neighbours minus the key of the block whose neighbours they
// are. The difference is modulo 2^bits of Key.
template <typename Key>
Key key_offset(const CellGrid& grid, const BlockRow& row) {
  const auto along = [&grid](int blocks, std::size_t axis) {
    return static_cast<Key>(static_cast<Key>(blocks) << grid.shift[axis]);
  };
  return static_cast<Key>(along(row.dz, 2) + along(row.dy, 1) + along(-1, 0));
}

// Joins each block from `begin` to `end` with the preceding blocks in one row of its neighbours. `first` is
// the index of the first block whose key is at least the key at which the row begins. The key of the row
// increases from block to block, so `first` never decreases.
template <typename T, typename Key>
void sweep(const JoinContext<T>& context, const std::vector<Key>& keys, Key offset,
           const std::array<TouchingAndNext, 3>& masks, std::size_t begin, std::size_t end,
           LinkScratch<T>& scratch) {
  const std::vector<Block>& blocks = context.cells.blocks;
  const auto key_of_row = [&](std::size_t block) { return static_cast<Key>(keys[block] + offset); };
  std::size_t first = std::lower_bound(keys.begin(), keys.begin() + begin, key_of_row(begin)) - keys.begin();
  for (std::size_t block = begin; block < end; ++block) {
    const Key row = key_of_row(block);
    while (keys[first] < row)
      ++first;
    for (std::size_t other = first; other < block && keys[other] - row <= 2; ++other)
      join_between(context, masks[static_cast<std::size_t>(keys[other] - row)], blocks[block], blocks[other],
                   scratch);
  }
}

template <typename T>
void find_non_solid(const Cells<T>& cells, T r2, std::vector<std::uint8_t>& non_solid) {
  non_solid.resize(cells.size());
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    const PointRun<T> run = cells.run(c);
    const Box<T> box = box_of(run.points, run.count);
    non_solid[c] = run.count > 1 && !(max_squared_distance(box, box) < r2);
  }
}

// Makes one set per cell. For a non-solid cell, makes one set per point.
template <typename T>
void start_sets(const JoinContext<T>& context) {
  const Cells<T>& cells = context.cells;
  context.sets.reset(cells.by_point ? cells.points.size() : cells.size());
  if (!cells.by_point) return;
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    for (std::uint32_t i = cells.begin[c]; i < cells.begin[c + 1] && !context.is_non_solid(c); ++i)
      context.sets.set_root(i, cells.begin[c]);
  }
}

// Reserves memory in each chunk for copies of any two cells, but at most for 4096 points of each cell. Which
// cells a thread compares depends on timing. Without the reserve, the number of allocations would also depend
// on timing.
template <typename T>
void reserve_links(const Cells<T>& cells, std::vector<LinkScratch<T>>& links, std::size_t chunks) {
  constexpr std::size_t max_reserved = 4096;
  std::size_t largest = 0;
  for (std::uint32_t c = 0; c < cells.size(); ++c)
    largest = std::max(largest, cells.run(c).count);
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    links[chunk].a.reserve(std::min(largest, max_reserved));
    links[chunk].b.reserve(std::min(largest, max_reserved));
  }
}

// Number of blocks that a thread takes at a time. Fewer blocks are not worth starting a thread.
constexpr std::size_t blocks_per_chunk = 256;

}  // namespace

template <typename T, typename Key>
void join_cells(const CellGrid& grid, T r2, const ParallelPolicy& policy, const std::vector<Key>& keys,
                Cells<T>& cells, UnionFind& sets, JoinScratch<T>& scratch) {
  const JoinContext<T> context{cells, scratch.non_solid, sets, r2};
  scratch.non_solid.clear();
  if (cells.by_point) find_non_solid(cells, r2, scratch.non_solid);
  start_sets(context);
  if (!(r2 > 0)) return;

  const std::size_t blocks = keys.size();
  const std::size_t chunks = (blocks + blocks_per_chunk - 1) / blocks_per_chunk;
  if (scratch.links.size() < chunks) scratch.links.resize(chunks);
  if (chunks > 1 && thread_count(policy) > 1) reserve_links(cells, scratch.links, chunks);
  const auto in_chunks = [&](auto work) {
    for_each_chunk(policy, chunks, [&](std::size_t chunk) {
      work(chunk * blocks_per_chunk, std::min(blocks, (chunk + 1) * blocks_per_chunk), scratch.links[chunk]);
    });
  };
  in_chunks([&](std::size_t begin, std::size_t end, LinkScratch<T>& links) {
    for (std::size_t b = begin; b < end; ++b) {
      if (cells.by_point) {
        join_within_by_pairs(context, cells.blocks[b], links);
      } else {
        join_within(context, cells.blocks[b], links);
      }
    }
  });
  in_chunks([&](std::size_t begin, std::size_t end, LinkScratch<T>& links) {
    for (std::size_t i = 0; i < half_of_neighbours.size(); ++i) {
      sweep(context, keys, key_offset<Key>(grid, half_of_neighbours[i]), next_to_block[i], begin, end, links);
    }
  });
}

// NOLINTBEGIN(bugprone-macro-parentheses): the arguments are types
#define PCL_BV_JOIN_CELLS(T, Key)                                                                         \
  template void join_cells(const CellGrid&, T, const ParallelPolicy&, const std::vector<Key>&, Cells<T>&, \
                           UnionFind&, JoinScratch<T>&);
// NOLINTEND(bugprone-macro-parentheses)
PCL_BV_JOIN_CELLS(float, std::uint64_t)
PCL_BV_JOIN_CELLS(float, WideKey)
PCL_BV_JOIN_CELLS(double, std::uint64_t)
PCL_BV_JOIN_CELLS(double, WideKey)
#undef PCL_BV_JOIN_CELLS

}  // namespace pcl_bv::detail
