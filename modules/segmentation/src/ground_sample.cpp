// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Sampling in two steps: evenly over the point numbers, then evenly over the area.
#include "ground_sample.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace pcl_bv {
namespace {

using Eigen::Vector3d;

constexpr std::size_t sample_size = 8192;  // of a 64-beam sweep one in 15, still 8 for each cell of area
constexpr std::size_t cells_per_side = 32;
constexpr std::size_t points_per_cell = 4;

// Up to sample_size valid points, in an order that has no beat with the rows of a sensor: steps of the golden
// section around the cloud visit each point once and cover it evenly at any moment.
void draw(const PointView& points, std::uint32_t seed, std::vector<Vector3d>& sample) {
  sample.clear();
  sample.reserve(sample_size);
  const std::size_t n = points.count;
  if (n == 0) return;
  auto step = static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(n));
  while (std::gcd(step, n) != 1)
    ++step;
  std::size_t i = seed % n;
  for (std::size_t visited = 0; visited < n && sample.size() < sample_size; ++visited) {
    const Coordinates p = load_point(points, i);
    if (is_valid(p)) sample.push_back({p.x, p.y, p.z});
    i = i + step < n ? i + step : i + step - n;
  }
}

struct Spread {
  double low, middle, high;
};

// The median of a coordinate and bounds that a few stray points do not move.
Spread spread_of(const std::vector<Vector3d>& sample, int axis) {
  std::array<double, 1024> values;
  const std::size_t n = std::min(sample.size(), values.size());
  for (std::size_t i = 0; i < n; ++i)
    values[i] = sample[i][axis];
  const auto begin = values.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(n);
  const auto tail = static_cast<std::ptrdiff_t>(n / 50);
  const auto middle = begin + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(begin, middle, end);
  std::nth_element(begin, begin + tail, middle);
  std::nth_element(middle, end - 1 - tail, end);
  const double low = *(begin + tail);
  const double high = *(end - 1 - tail);
  const double margin = 0.5 * (high - low);
  return {low - margin, *middle, high + margin};
}

// Row or column of the grid; the outermost ones hold all that is beyond them.
std::size_t grid_line(double value, const Spread& spread) {
  if (!(spread.high > spread.low)) return 0;
  const double line = (value - spread.low) / (spread.high - spread.low) * cells_per_side;
  return static_cast<std::size_t>(std::clamp(line, 0.0, cells_per_side - 1.0));
}

struct Cell {
  std::size_t count = 0;
  std::size_t lowest = 0;  // its lowest point's place in GroundScratch::lowest
};

// Puts a point into its cell: the first few are support.
void add(const Vector3d& p, const Vector3d& upward, Cell& cell, GroundScratch& scratch) {
  if (cell.count < points_per_cell) scratch.support.push_back(p);
  if (cell.count == 0) {
    cell.lowest = scratch.lowest.size();
    scratch.lowest.push_back(p);
  } else if (p.dot(upward) < scratch.lowest[cell.lowest].dot(upward)) {
    scratch.lowest[cell.lowest] = p;
  }
  ++cell.count;
}

}  // namespace

Vector3d sample_ground(const PointView& points, UpAxis up, std::uint32_t seed, GroundScratch& scratch) {
  constexpr std::size_t cells = cells_per_side * cells_per_side;
  scratch.support.clear();
  scratch.support.reserve(cells * points_per_cell);
  scratch.lowest.clear();
  scratch.lowest.reserve(cells);
  draw(points, seed, scratch.sample);
  if (scratch.sample.empty()) return Vector3d::Zero();

  const std::array<Spread, 3> spread{spread_of(scratch.sample, 0), spread_of(scratch.sample, 1),
                                     spread_of(scratch.sample, 2)};
  Vector3d origin(spread[0].middle, spread[1].middle, spread[2].middle);
  const Vector3d upward = up_direction(up);
  const std::size_t u = (static_cast<std::size_t>(up) + 1) % 3;
  const std::size_t v = (static_cast<std::size_t>(up) + 2) % 3;
  std::array<Cell, cells> grid{};
  for (Vector3d& p : scratch.sample) {
    Cell& cell = grid[grid_line(p[u], spread[u]) * cells_per_side + grid_line(p[v], spread[v])];
    p -= origin;
    add(p, upward, cell, scratch);
  }
  return origin;
}

}  // namespace pcl_bv
