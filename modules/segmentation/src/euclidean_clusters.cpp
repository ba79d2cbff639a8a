// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/euclidean_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "cells.h"
#include "core_points.h"
#include "gather.h"
#include "join_cells.h"
#include "pcl_bv/numeric/float_environment.h"

namespace pcl_bv {
namespace {

// The memory that calls share, by kind of point.
template <typename T>
struct PointScratch {
  ValidPoints<T> valid;
  Cells<T> cells;
  JoinScratch<T> join;
  CoreScratch<T> core;
};

struct Component {
  std::uint32_t root, size, first_point;
};

// Components by root, and where the next index of each goes.
struct Collector {
  std::vector<std::uint32_t> size;
  std::vector<std::uint32_t> next;  // `unseen` before, `dropped` if of a size not wanted.
  std::vector<Component> kept;
};
constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t dropped = unseen - 1;

void check(const ClusterSettings& settings) {
  std::ostringstream message;
  if (!(settings.tolerance > 0 && std::isfinite(settings.tolerance))) {
    message << "cluster tolerance is " << settings.tolerance << ", must be finite and greater than 0";
  } else if (settings.min_size > settings.max_size) {
    message << "cluster min_size is " << settings.min_size << ", must be at most max_size, "
            << settings.max_size;
  } else if (settings.min_points == 0) {
    message << "cluster min_points is 0, must be at least 1";
  } else {
    return;
  }
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

// Whether all pairs of points in a cell are linked for certain: the margin of the cells' side covers the
// rounding of d2 where it is relative to d2, and that of where cells end.
template <typename T>
bool cells_are_solid(const CellGrid& grid, T r2) {
  return grid.near && r2 >= T(1e-30) && r2 <= T(1e30);
}

// The root of noise where every valid point is in a cluster.
constexpr std::uint32_t no_root = std::numeric_limits<std::uint32_t>::max();

// Returns the root of noise. With min_points of 1 every point is core, and nothing is looked for.
template <typename T, typename Key>
std::uint32_t find_components(PointScratch<T>& scratch, const CellGrid& grid, T r2, std::size_t min_points,
                              const ParallelPolicy& policy, BlockKeys<Key>& keys, UnionFind& sets) {
  const bool solid = cells_are_solid(grid, r2);
  scratch.cells.by_point = !solid || min_points > 1;
  make_cells(scratch.valid.points, grid, policy, scratch.cells, keys);
  std::uint32_t noise = no_root;
  if (min_points > 1) {
    find_core(grid, r2, min_points, solid, policy, keys.keys, scratch.cells, scratch.core);
    scratch.cells.by_point = !solid;
    noise = keep_core(scratch.cells, scratch.core);
  }
  join_cells(grid, r2, policy, keys.keys, scratch.cells, sets, scratch.join);
  if (noise != no_root) sets.add();
  return noise;
}

// Sizes, and the components to keep in the order of the result.
void select(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node,
            std::uint32_t noise, const ClusterSettings& settings, Collector& collector, Clusters& clusters) {
  collector.size.assign(roots.size(), 0);
  for (const std::uint32_t n : node)
    ++collector.size[roots[n]];
  collector.next.assign(roots.size(), unseen);
  collector.kept.clear();
  for (std::uint32_t i = 0; i < node.size(); ++i) {
    const std::uint32_t root = roots[node[i]];
    if (collector.next[root] != unseen) continue;
    collector.next[root] = dropped;
    const std::uint32_t size = collector.size[root];
    if (root == noise) {
      clusters.noise_points = size;
    } else if (size < settings.min_size) {
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

void write(const std::vector<std::uint32_t>& roots, const std::vector<std::uint32_t>& node,
           const std::vector<std::int32_t>& numbers, Collector& collector, Clusters& clusters) {
  std::uint32_t end = 0;
  for (const Component& component : collector.kept) {
    collector.next[component.root] = end;
    end += component.size;
    clusters.offsets.push_back(end);
  }
  clusters.indices.resize(end);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::uint32_t& next = collector.next[roots[node[i]]];
    if (next != dropped) clusters.indices[next++] = numbers[i];
  }
}

}  // namespace

struct EuclideanClusterer::Scratch {
  std::tuple<PointScratch<float>, PointScratch<double>> points;
  BlockKeys<std::uint64_t> keys;
  BlockKeys<WideKey> wide_keys;
  UnionFind sets;
  Collector collector;

  template <typename T>
  void extract(const PointView& view, const ClusterSettings& settings, const ParallelPolicy& policy,
               Clusters& clusters) {
    auto& scratch = std::get<PointScratch<T>>(points);
    const std::vector<Point<T>>& valid = scratch.valid.points;
    gather(view, policy, scratch.valid);
    if (valid.empty()) return;

    const double r = settings.tolerance;
    const T r2 = static_cast<T>(r * r);
    const CellGrid grid(scratch.valid.box, inverse_cell_side(r2));
    const std::uint32_t noise =
        grid.key_bits <= 64
            ? find_components(scratch, grid, r2, settings.min_points, policy, keys, sets)
            : find_components(scratch, grid, r2, settings.min_points, policy, wide_keys, sets);
    const std::vector<std::uint32_t>& roots = sets.roots();
    select(roots, scratch.cells.node, noise, settings, collector, clusters);
    write(roots, scratch.cells.node, scratch.valid.numbers, collector, clusters);
  }
};

EuclideanClusterer::EuclideanClusterer() = default;
EuclideanClusterer::~EuclideanClusterer() = default;
EuclideanClusterer::EuclideanClusterer(EuclideanClusterer&&) noexcept = default;
EuclideanClusterer& EuclideanClusterer::operator=(EuclideanClusterer&&) noexcept = default;

void EuclideanClusterer::extract(const PointView& points, const ClusterSettings& settings, Clusters& clusters,
                                 const ParallelPolicy& policy) {
  const FloatEnvironment environment;
  check(settings);
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  clusters.small_points = 0;
  clusters.large_points = 0;
  clusters.noise_points = 0;
  if (!scratch_) scratch_ = std::make_unique<Scratch>();
  if (points.scalar == ScalarType::float32) {
    scratch_->extract<float>(points, settings, policy, clusters);
  } else {
    scratch_->extract<double>(points, settings, policy, clusters);
  }
}

}  // namespace pcl_bv
