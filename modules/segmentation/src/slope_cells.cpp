// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "slope_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pcl_bv/parallel/for_each_chunk.h"
#include "union_find.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kCellsAtATime = 4096;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Offset {
  int dx, dy;
  double distance;
};

// Returns the offsets to the cells within `radius`, the nearest first.
std::vector<Offset> offsets_within(int radius) {
  std::vector<Offset> offsets;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const int square = dx * dx + dy * dy;
      if (square > 0 && square <= radius * radius) offsets.push_back({dx, dy, std::sqrt(square)});
    }
  }
  std::stable_sort(offsets.begin(), offsets.end(),
                   [](const Offset& a, const Offset& b) { return a.distance < b.distance; });
  return offsets;
}

class LowOutliers {
 public:
  LowOutliers(const SlopeCells& cells, double rise, double margin, const ParallelPolicy& policy)
      : cells_(cells), rise_(rise), margin_(margin), size_(cells.size()) {
    UnionFind patches;
    patches.reset(cells.size());
    for_each_range(policy, cells.size(), kCellsAtATime, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        link(static_cast<std::uint32_t>(i), patches);
    });
    root_ = patches.roots();
    for (const std::uint32_t root : root_)
      ++size_[root];
  }

  // A cell that is above a cell of a larger patch does not change the envelope, so it need not be dropped.
  bool contains(std::uint32_t cell) const {
    if (is_large(cell)) return false;
    for (const Offset& offset : far_) {
      const std::optional<std::uint32_t> other = cells_.neighbour(cells_[cell].at, offset.dx, offset.dy);
      if (!other || !is_large(*other)) continue;
      if (is_above(*other, cell, offset.distance)) return true;
      if (is_above(cell, *other, offset.distance)) return false;
    }
    return false;
  }

 private:
  // Each pair of cells is visited from one of them.
  void link(std::uint32_t cell, UnionFind& patches) const {
    for (const Offset& offset : near_) {
      if (offset.dy < 0 || (offset.dy == 0 && offset.dx < 0)) continue;
      const std::optional<std::uint32_t> other = cells_.neighbour(cells_[cell].at, offset.dx, offset.dy);
      if (other && std::abs(cells_[*other].height - cells_[cell].height) <= rise_ + margin_)
        patches.unite(cell, *other);
    }
  }

  // Returns whether `cell` is higher than a cone on `base` by more than the margin.
  bool is_above(std::uint32_t cell, std::uint32_t base, double distance) const {
    return cells_[cell].height > cells_[base].height + rise_ * distance + margin_;
  }

  bool is_large(std::uint32_t cell) const { return size_[root_[cell]] >= kPatchCells; }

  const SlopeCells& cells_;
  double rise_, margin_;
  std::vector<std::uint32_t> root_, size_;  // of the patch of each cell; sizes are stored at the root
  std::vector<Offset> near_ = offsets_within(kLinkedCells), far_ = offsets_within(kFarFromOutlier);
};

// Inserts a 0 before each bit.
std::uint64_t spread(std::uint32_t bits) {
  std::uint64_t x = bits;
  x = (x | x << 16U) & 0x0000ffff0000ffffU;
  x = (x | x << 8U) & 0x00ff00ff00ff00ffU;
  x = (x | x << 4U) & 0x0f0f0f0f0f0f0f0fU;
  x = (x | x << 2U) & 0x3333333333333333U;
  return (x | x << 1U) & 0x5555555555555555U;
}

std::uint32_t from_zero(std::int32_t position) {
  return static_cast<std::uint32_t>(position) ^ 0x80000000U;
}

// The lower envelope of cones by a quadtree of the cells. A node is skipped if even a cone at its nearest
// corner with its lowest height would not lower the result. Rounding is monotone, so bounds and heights can
// be compared without a margin, and the result is exactly the minimum of the rounded values.
class Envelope {
 public:
  Envelope(const SlopeCells& cells, const std::vector<std::uint8_t>& outlier, double rise) : rise_(rise) {
    add_leaves(cells, outlier);
    while (levels_.back().size() > 1)
      add_level();
  }

  // Calls set(cell, height) for the leaves from `begin` to `end`. They are in the order of the Z-curve, so
  // the lowest cone of one cell is a good first guess for the next cell.
  template <typename Set>
  void find(std::size_t begin, std::size_t end, const Set& set) const {
    const std::vector<Node>& leaves = levels_.front();
    std::size_t guess = begin;
    for (std::size_t i = begin; i < end; ++i) {
      Minimum best{kInfinity, i};
      take(leaves[i], guess, best);
      take(leaves[i], i, best);
      visit(levels_.size() - 1, 0, leaves[i], best);
      guess = best.leaf;
      set(cell_[i], best.height);
    }
  }

 private:
  struct Node {
    std::uint32_t x, y;   // in units of the side of the level's nodes
    std::uint32_t first;  // first child
    double lowest;
  };
  struct Minimum {
    double height;
    std::size_t leaf;
  };

  void add_leaves(const SlopeCells& cells, const std::vector<std::uint8_t>& outlier) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(cells.size());
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      const CellPosition at = cells[i].at;
      order[i] = {spread(from_zero(at.x)) | spread(from_zero(at.y)) << 1U, i};
    }
    std::sort(order.begin(), order.end());
    std::vector<Node> leaves;
    leaves.reserve(cells.size());
    for (const auto& [key, i] : order) {
      const CellPosition at = cells[i].at;
      leaves.push_back({from_zero(at.x), from_zero(at.y), 0, outlier[i] != 0 ? kInfinity : cells[i].height});
      cell_.push_back(i);
    }
    levels_.push_back(std::move(leaves));
  }

  void add_level() {
    const std::vector<Node>& below = levels_.back();
    std::vector<Node> level;
    for (std::uint32_t i = 0; i < below.size(); ++i) {
      const std::uint32_t x = below[i].x >> 1U, y = below[i].y >> 1U;
      if (level.empty() || level.back().x != x || level.back().y != y) level.push_back({x, y, i, kInfinity});
      level.back().lowest = std::min(level.back().lowest, below[i].lowest);
    }
    levels_.push_back(std::move(level));
  }

  // Returns lowest + rise * distance, with the distance from the cell `from` to the nearest cell of the node.
  double bound(std::size_t level, const Node& node, const Node& from) const {
    const auto gap = [level](std::uint32_t number, std::uint32_t position) {
      const std::uint64_t low = std::uint64_t{number} << level,
                          high = ((std::uint64_t{number} + 1) << level) - 1;
      if (position < low) return static_cast<double>(low - position);
      return position > high ? static_cast<double>(position - high) : 0.0;
    };
    const double dx = gap(node.x, from.x), dy = gap(node.y, from.y);
    return node.lowest + rise_ * std::sqrt(dx * dx + dy * dy);
  }

  void take(const Node& from, std::size_t leaf, Minimum& best) const {
    const double height = bound(0, levels_.front()[leaf], from);
    if (height < best.height) best = {height, leaf};
  }

  // NOLINTNEXTLINE(misc-no-recursion): at most 33 levels
  void visit(std::size_t level, std::size_t number, const Node& from, Minimum& best) const {
    if (level == 0) return take(from, number, best);
    const std::vector<Node>& below = levels_[level - 1];
    const std::size_t begin = levels_[level][number].first, end = number + 1 < levels_[level].size()
                                                                      ? levels_[level][number + 1].first
                                                                      : below.size();
    std::array<std::pair<double, std::size_t>, 4> children;
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double least = bound(level - 1, below[i], from);
      if (least < best.height) children[count++] = {least, i};
    }
    std::sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count && children[i].first < best.height; ++i)
      visit(level - 1, children[i].second, from, best);
  }

  double rise_;
  std::vector<std::vector<Node>> levels_;  // leaves first
  std::vector<std::uint32_t> cell_;        // number of each leaf in SlopeCells
};

// Returns the less steep of two rises; 0 if their signs differ.
double less_steep(double a, double b) {
  if (!(a * b > 0)) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

float rise_along(const SlopeCells& cells, const SlopeCell& cell, int dx, int dy) {
  const auto before = cells.neighbour(cell.at, -dx, -dy), after = cells.neighbour(cell.at, dx, dy);
  if (!before || !after) return 0;
  const double to = cells[*after].height - cell.height, from = cell.height - cells[*before].height;
  return static_cast<float>(less_steep(from, to));
}

}  // namespace

std::optional<std::uint32_t> SlopeCells::neighbour(CellPosition at, int dx, int dy) const {
  const std::int64_t x = std::int64_t{at.x} + dx, y = std::int64_t{at.y} + dy;
  const CellPosition other{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
  return other.x == x && other.y == y ? find(other) : std::nullopt;
}

std::vector<std::uint8_t> low_outliers(const SlopeCells& cells, double rise, double margin,
                                       const ParallelPolicy& policy) {
  std::vector<std::uint8_t> outlier(cells.size());
  const LowOutliers outliers(cells, rise, margin, policy);
  for_each_range(policy, cells.size(), kCellsAtATime, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      outlier[i] = outliers.contains(static_cast<std::uint32_t>(i)) ? 1 : 0;
  });
  return outlier;
}

void find_envelope(const std::vector<std::uint8_t>& outlier, double rise, const ParallelPolicy& policy,
                   SlopeCells& cells) {
  if (cells.size() == 0) return;
  const Envelope envelope(cells, outlier, rise);
  for_each_range(policy, cells.size(), kCellsAtATime, [&](std::size_t begin, std::size_t end) {
    envelope.find(begin, end, [&](std::uint32_t cell, double height) { cells[cell].height = height; });
  });
}

void find_rises(const ParallelPolicy& policy, SlopeCells& cells) {
  for_each_range(policy, cells.size(), kCellsAtATime, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      cells[i].rise_x = rise_along(cells, cells[i], 1, 0);
      cells[i].rise_y = rise_along(cells, cells[i], 0, 1);
    }
  });
}

}  // namespace pcl_bv::detail
