// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/clusters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "cells.h"
#include "collect.h"
#include "components.h"
#include "core_points.h"
#include "join_cells.h"
#include "oversized.h"
#include "pcl_bv/numeric/float_environment.h"
#include "range_levels.h"
#include "valid_points.h"

namespace pcl_bv {
using namespace detail;
namespace {

// The buffers for one scalar type, which calls reuse.
template <typename T>
struct PointScratch {
  ValidPoints<T> valid;
  Cells<T> cells;
  JoinScratch<T> join;
  CoreScratch<T> core;
  RangeLevels<T> levels;
};

}  // namespace

void detail::check(const ClusterOptions& options) {
  std::ostringstream message;
  if (!(options.tolerance > 0 && std::isfinite(options.tolerance))) {
    message << "cluster tolerance is " << options.tolerance << ", must be finite and greater than 0";
  } else if (options.min_size > options.max_size) {
    message << "cluster min_size is " << options.min_size << ", must be at most max_size, "
            << options.max_size;
  } else if (options.min_points == 0) {
    message << "cluster min_points is 0, must be at least 1";
  } else if (!(options.tolerance_per_metre >= 0 && std::isfinite(options.tolerance_per_metre))) {
    message << "cluster tolerance_per_metre is " << options.tolerance_per_metre
            << ", must be finite and at least 0";
  } else if (options.tolerance_per_metre > 0 && options.min_points > 1) {
    message << "cluster min_points is " << options.min_points
            << ", must be 1 if tolerance_per_metre is above 0";
  } else if (!(options.range_origin.cwiseAbs().array() <= kMaxCoordinate).all()) {
    message << "cluster range_origin is " << options.range_origin.transpose()
            << ", must be from -1e100 to 1e100 along each axis";
  } else {
    return;
  }
  throw std::invalid_argument(message.str());
}

namespace {

// The only r2 for which points of one cell may not be linked: no side of a cell covers the rounding of the
// squares, and cells of linked points are at most two apart. Tolerances from 5.9e-23 to 7e-23 have it.
constexpr float not_solid_r2 = 3 * std::numeric_limits<float>::denorm_min();

// Returns 1 / side of the cells. The margin of 1e-6 covers the rounding of d2 (5 * 2^-24) and of the numbers
// of cells near the origin (2^-23), so that points of one cell are linked. Denormal squares are rounded to
// multiples of the smallest float. Those of the side are rounded to the largest multiple below r2 / 3.
template <typename T>
double inverse_cell_side(T r2) {
  using limits = std::numeric_limits<T>;
  const double step = limits::denorm_min();
  const double side = r2 > 0 && r2 < limits::min() && r2 != not_solid_r2
                          ? std::sqrt((std::floor((r2 / step - 1) / 3) + 0.5) * step)
                          : max_linked_difference(r2) / std::sqrt(3.0);
  return (1 + 1e-6) / side;
}

// Finds the connected components. Returns the root of noise. If min_points is 1, every point is a core point,
// and the function returns no_root.
template <typename T, typename Key>
std::uint32_t find_components(const std::vector<Point<T>>& points, PointScratch<T>& scratch,
                              const CellGrid& grid, T r2, std::size_t min_points,
                              const ParallelPolicy& policy, BlockKeys<Key>& keys, UnionFind& sets) {
  const bool solid = r2 > 0 && r2 != not_solid_r2;  // without a tolerance not even duplicates are linked
  scratch.cells.by_point = !solid || min_points > 1;
  make_cells(points, grid, policy, scratch.cells, keys);
  if (keys.keys.size() >= free_memory_from_blocks) keys.release_memory();
  std::uint32_t noise = no_root;
  if (min_points > 1) {
    find_core(grid, r2, min_points, solid, policy, keys.keys, scratch.cells, scratch.core);
    scratch.cells.by_point = !solid;
    noise = remove_non_core(scratch.cells, scratch.core);
  }
  join_cells(grid, r2, policy, keys.keys, scratch.cells, sets, scratch.join);
  if (noise != no_root) sets.add();
  return noise;
}

}  // namespace

struct EuclideanClusterer::Scratch {
  std::tuple<PointScratch<float>, PointScratch<double>> points;
  BlockKeys<std::uint64_t> keys;
  BlockKeys<WideKey> wide_keys;
  UnionFind sets;
  std::vector<std::uint32_t> same;  // 0, 1, 2, ...
  Collector collector;
  SplitScratch split;

  /// Links the points at one tolerance. Point i is then in the component sets.roots()[scratch.cells.node[i]].
  /// Returns the root of noise.
  template <typename T>
  std::uint32_t link(const std::vector<Point<T>>& all, const Box<T>& box, double r, std::size_t min_points,
                     const ParallelPolicy& policy) {
    auto& scratch = std::get<PointScratch<T>>(points);
    const T r2 = static_cast<T>(r * r);
    const CellGrid grid(all, box, inverse_cell_side(r2));
    return grid.key_bits <= 64 ? find_components(all, scratch, grid, r2, min_points, policy, keys, sets)
                               : find_components(all, scratch, grid, r2, min_points, policy, wide_keys, sets);
  }

  template <typename T>
  void link_by_range(const ClusterOptions& options, const ParallelPolicy& policy) {
    auto& scratch = std::get<PointScratch<T>>(points);
    RangeLevels<T>& levels = scratch.levels;
    levels.start(scratch.valid.points, options);
    while (levels.next()) {
      link(levels.points(), box_of(levels.points().data(), levels.points().size()), levels.tolerance(), 1,
           policy);
      levels.unite(sets.roots(), scratch.cells.node);
    }
  }

  template <typename T>
  void extract(const PointView& view, const ClusterOptions& options, const ParallelPolicy& policy,
               Clusters& clusters) {
    auto& scratch = std::get<PointScratch<T>>(points);
    copy_valid_points(view, policy, scratch.valid);
    const std::size_t count = scratch.valid.points.size();
    if (count == 0) return;
    if (options.tolerance_per_metre > 0) {
      link_by_range<T>(options, policy);
      same.resize(count);
      std::iota(same.begin(), same.end(), 0U);
      write_clusters(scratch.levels.roots(), same, no_root, scratch.valid.numbers, options, collector,
                     clusters);
      return;
    }
    const std::uint32_t noise =
        link(scratch.valid.points, scratch.valid.box, options.tolerance, options.min_points, policy);
    write_clusters(sets.roots(), scratch.cells.node, noise, scratch.valid.numbers, options, collector,
                   clusters);
  }

  /// Appends the clusters to `clusters`. Omits clusters above max_size only for Oversized::drop.
  void append(const PointView& view, ClusterOptions options, const ParallelPolicy& policy,
              Clusters& clusters) {
    if (options.oversized != Oversized::drop) options.max_size = std::numeric_limits<std::size_t>::max();
    view.scalar == ScalarType::float32 ? extract<float>(view, options, policy, clusters)
                                       : extract<double>(view, options, policy, clusters);
  }
};

template <typename T>
void ComponentAccess::find(EuclideanClusterer& clusterer, const PointView& view,
                           const ClusterOptions& options, const ParallelPolicy& policy,
                           PointComponents& found) {
  if (!clusterer.scratch_) clusterer.scratch_ = std::make_unique<EuclideanClusterer::Scratch>();
  EuclideanClusterer::Scratch& all = *clusterer.scratch_;
  auto& scratch = std::get<PointScratch<T>>(all.points);
  copy_valid_points(view, policy, scratch.valid);
  const std::size_t count = scratch.valid.points.size();
  if (count != view.count) throw std::invalid_argument("all points must be valid");
  found.component.resize(count);
  found.core.assign(count, 1);
  found.noise = no_root;
  if (count == 0) return;
  found.noise =
      all.link(scratch.valid.points, scratch.valid.box, options.tolerance, options.min_points, policy);
  const std::vector<std::uint32_t>& roots = all.sets.roots();
  for (std::size_t i = 0; i < count; ++i)
    found.component[i] = roots[scratch.cells.node[i]];
  if (options.min_points == 1) return;
  for (std::size_t position = 0; position < count; ++position)
    found.core[scratch.core.number[position]] = scratch.core.core[position];
}

void ComponentAccess::find(EuclideanClusterer& clusterer, const PointView& view,
                           const ClusterOptions& options, const ParallelPolicy& policy,
                           PointComponents& found) {
  view.scalar == ScalarType::float32 ? find<float>(clusterer, view, options, policy, found)
                                     : find<double>(clusterer, view, options, policy, found);
}

EuclideanClusterer::EuclideanClusterer() = default;
EuclideanClusterer::~EuclideanClusterer() = default;
EuclideanClusterer::EuclideanClusterer(EuclideanClusterer&&) noexcept = default;
EuclideanClusterer& EuclideanClusterer::operator=(EuclideanClusterer&&) noexcept = default;

void EuclideanClusterer::extract(const PointView& points, const ClusterOptions& options, Clusters& clusters,
                                 const Execution& execution) {
  const FloatEnvironment environment;
  check(options);
  clusters.indices.clear();
  clusters.offsets.assign(1, 0);
  clusters.small_points = 0;
  clusters.large_points = 0;
  clusters.noise_points = clusters.class_points = 0;
  if (!scratch_) scratch_ = std::make_unique<Scratch>();
  scratch_->append(points, options, execution.parallel, clusters);
  if (options.oversized != Oversized::split) return;
  const auto again = [&](const PointView& part, const ClusterOptions& finer, Clusters& to) {
    scratch_->append(part, finer, execution.parallel, to);
  };
  split_oversized(points, options, std::cref(again), clusters, scratch_->split);
}

Clusters cluster(const PointView& points, const ClusterOptions& options, const Execution& execution) {
  Clusters clusters;
  EuclideanClusterer().extract(points, options, clusters, execution);
  return clusters;
}

}  // namespace pcl_bv
