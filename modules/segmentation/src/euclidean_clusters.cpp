// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Exact Euclidean clusters: the steps in order, and the collecting of the result.
#include "pcl_bv/segmentation/euclidean_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "cells.h"
#include "gather.h"
#include "pcl_bv/kernels/float_environment.h"

namespace pcl_bv {
namespace {

// The memory that calls share, by kind of point.
template <typename T>
struct PointScratch {
  ValidPoints<T> valid;
  Cells<T> cells;
};

struct Component {
  std::uint32_t root, size, first_point;
};

// Components by cell, and where the next index of each goes.
struct Collector {
  std::vector<std::uint32_t> size;  // Points of each root's component.
  std::vector<std::size_t> next;    // By root; `unseen` before, `dropped` if of a size not wanted.
  std::vector<Component> kept;
};
constexpr std::size_t unseen = std::numeric_limits<std::size_t>::max();
constexpr std::size_t dropped = unseen - 1;

void check(float tolerance) {
  if (tolerance > 0 && std::isfinite(tolerance)) return;
  std::ostringstream message;
  message << "cluster tolerance is " << tolerance << ", must be finite and greater than 0";
  throw std::invalid_argument(message.str());
}

// 1 / side of the cells. sqrt(r2), not the tolerance, bounds the coordinates' differences of a pair d2 < r2:
// r2 may have been rounded up among the denormals, or to infinity, when d2 still has to be finite. The margin
// of 1e-6 covers the rounding of d2 (5 * 2^-24), so that points of one cell pass the test.
template <typename T>
double inverse_cell_side(T r2) {
  using limits = std::numeric_limits<T>;
  const double reach = std::sqrt(static_cast<double>(std::clamp(r2, limits::denorm_min(), limits::max())));
  return std::sqrt(3.0) * (1 + 1e-6) / reach;
}

template <typename T, typename Key>
void find_components(PointScratch<T>& scratch, const CellGrid& grid, T r2, CellKeys<Key>& keys,
                     UnionFind& sets) {
  make_cells(scratch.valid.points, grid, r2, scratch.cells, keys);
  sets.reset(scratch.cells.size());
  if (r2 > 0) join_cells(grid, r2, scratch.cells, keys.keys, sets);
}

// Sizes, and the components to keep in the order of the result.
template <typename T>
void select(const Cells<T>& cells, UnionFind& sets, const ClusterSettings& settings, Collector& collector,
            Clusters& clusters) {
  collector.size.assign(cells.size(), 0);
  for (std::uint32_t cell = 0; cell < cells.size(); ++cell) {
    collector.size[sets.find(cell)] += cells.count(cell);
  }
  collector.next.assign(cells.size(), unseen);
  collector.kept.clear();
  const auto n = static_cast<std::uint32_t>(cells.cell_of_point.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t root = sets.find(cells.cell_of_point[i]);
    if (collector.next[root] != unseen) continue;
    collector.next[root] = dropped;
    const std::uint32_t size = collector.size[root];
    if (size < settings.min_size) {
      clusters.small_points += size;
    } else if (size > settings.max_size) {
      clusters.large_points += size;
    } else {
      collector.kept.push_back({root, size, i});
    }
  }
  std::sort(collector.kept.begin(), collector.kept.end(), [](const Component& a, const Component& b) {
    return a.size != b.size ? a.size > b.size : a.first_point < b.first_point;
  });
}

void write(const std::vector<std::uint32_t>& cell_of_point, const std::vector<std::int32_t>& numbers,
           UnionFind& sets, Collector& collector, Clusters& clusters) {
  for (const Component& component : collector.kept) {
    collector.next[component.root] = clusters.offsets.back();
    clusters.offsets.push_back(clusters.offsets.back() + component.size);
  }
  clusters.indices.resize(clusters.offsets.back());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::size_t& next = collector.next[sets.find(cell_of_point[i])];
    if (next != dropped) clusters.indices[next++] = numbers[i];
  }
}

}  // namespace

struct EuclideanClusterer::Scratch {
  std::tuple<PointScratch<float>, PointScratch<double>> points;
  std::tuple<CellKeys<std::uint32_t>, CellKeys<std::uint64_t>, CellKeys<WideKey>> keys;
  UnionFind sets;
  Collector collector;

  template <typename T>
  void extract(const PointView& view, const ClusterSettings& settings, Clusters& clusters);
};

template <typename T>
void EuclideanClusterer::Scratch::extract(const PointView& view, const ClusterSettings& settings,
                                          Clusters& clusters) {
  auto& scratch = std::get<PointScratch<T>>(points);
  const std::vector<Point<T>>& valid = scratch.valid.points;
  gather(view, scratch.valid);
  if (valid.empty()) return;

  const double r = settings.tolerance;
  const T r2 = static_cast<T>(r * r);
  const CellGrid grid(box_of(valid.data(), valid.size()), inverse_cell_side(r2));
  if (grid.key_bits <= 32) {
    find_components(scratch, grid, r2, std::get<CellKeys<std::uint32_t>>(keys), sets);
  } else if (grid.key_bits <= 64) {
    find_components(scratch, grid, r2, std::get<CellKeys<std::uint64_t>>(keys), sets);
  } else {
    find_components(scratch, grid, r2, std::get<CellKeys<WideKey>>(keys), sets);
  }
  select(scratch.cells, sets, settings, collector, clusters);
  write(scratch.cells.cell_of_point, scratch.valid.numbers, sets, collector, clusters);
}

EuclideanClusterer::EuclideanClusterer() = default;
EuclideanClusterer::~EuclideanClusterer() = default;
EuclideanClusterer::EuclideanClusterer(EuclideanClusterer&&) noexcept = default;
EuclideanClusterer& EuclideanClusterer::operator=(EuclideanClusterer&&) noexcept = default;

void EuclideanClusterer::extract(const PointView& points, const ClusterSettings& settings,
                                 Clusters& clusters) {
  const FloatEnvironment environment;
  check(settings.tolerance);
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  clusters.small_points = 0;
  clusters.large_points = 0;
  if (!scratch_) scratch_ = std::make_unique<Scratch>();
  if (points.scalar == ScalarType::float32) {
    scratch_->extract<float>(points, settings, clusters);
  } else {
    scratch_->extract<double>(points, settings, clusters);
  }
}

}  // namespace pcl_bv
