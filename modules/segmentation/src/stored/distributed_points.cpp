// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed_points.h"

#include <algorithm>
#include <stdexcept>

#include "components.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "pcl_bv/points/point_source.h"
#include "record.h"

namespace pcl_bv::detail {
namespace {

// Bricks with fewer points have too many points of their neighbours.
constexpr std::size_t kFewPoints = 1U << 18U;

// Calls work(part, first, result) for chunks of the points, in parallel, and then take(result) for the
// results in the order of the chunks.
template <typename Result, typename Work, typename Take>
void in_order(const PointView& points, const ParallelPolicy& policy, const Work& work, const Take& take) {
  const std::size_t chunks = chunk_count(points.count);
  std::vector<Result> results(std::min<std::size_t>(chunks, std::size_t{4} * thread_count(policy)));
  for (std::size_t begin = 0; begin < chunks; begin += results.size()) {
    const std::size_t taken = std::min(results.size(), chunks - begin);
    for_each_chunk(policy, taken, [&](std::size_t i) {
      const std::size_t first = (begin + i) * kChunkPoints;
      const LoadedPoints part(points, first, std::min(kChunkPoints, points.count - first));
      results[i].clear();
      work(part.view(), first, results[i]);
    });
    for (std::size_t i = 0; i < taken; ++i)
      take(results[i]);
  }
}

// Runs of points in the same cell.
struct CellCounts {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> runs;  // key of the cell, and points
  std::size_t invalid = 0;

  void clear() {
    runs.clear();
    invalid = 0;
  }
};

// Counts the points of each cell. Returns the number of points that are not valid.
std::size_t count_cells(const PointView& points, const ParallelPolicy& policy, Bricks& bricks) {
  std::size_t invalid = 0;
  in_order<CellCounts>(
      points, policy,
      [&](const PointView& part, std::size_t, CellCounts& counts) {
        GridCell cell;
        for (std::size_t i = 0; i < part.count; ++i) {
          const Coordinates p = load_point(part, i);
          if (!is_valid(p)) {
            ++counts.invalid;
            continue;
          }
          if (const auto at = bricks.grid().scaled(p); !cell.contains(at)) {
            cell = bricks.grid().cell_of(at);
            counts.runs.emplace_back(cell.key, 0);
          }
          ++counts.runs.back().second;
        }
      },
      [&](const CellCounts& counts) {
        for (const auto& [key, count] : counts.runs)
          bricks.count(key, count);
        invalid += counts.invalid;
      });
  return invalid;
}

// Records of points, and the brick of each.
struct PlacedPoints {
  std::vector<std::byte> records;
  std::vector<std::uint32_t> bricks;

  void clear() {
    records.clear();
    bricks.clear();
  }
  void add(const std::byte* record, std::size_t bytes, std::uint32_t brick) {
    records.insert(records.end(), record, record + bytes);
    bricks.push_back(brick);
  }
};

void place_points(const PointView& part, std::size_t first, const Bricks& bricks, PlacedPoints& placed) {
  const std::size_t step = point_bytes(part.scalar);
  std::byte record[record_bytes(ScalarType::float64)];
  Bricks::Cursor cursor;
  for (std::size_t i = 0; i < part.count; ++i) {
    const Coordinates p = load_point(part, i);
    if (!is_valid(p)) continue;
    const Bricks::Place place = bricks.place(p, cursor);
    if (place.own == Bricks::kNone) throw std::runtime_error(kPointsChanged);
    write_coordinates(p, part.scalar, record);
    const auto add = [&](std::uint32_t brick, std::uint64_t number) {
      std::memcpy(record + step, &number, sizeof number);
      placed.add(record, step + sizeof number, brick);
    };
    add(place.own, (first + i) | (place.others > 0 ? kInOtherBricks : 0));
    for (std::uint32_t o = 0; o < place.others; ++o)
      add(place.other[o], (first + i) | kOfOtherBrick);
  }
}

// Writes the points to the lists of their bricks. The points of a list are in the order of the cloud.
std::vector<SpillList> write_lists(const PointView& points, const Bricks& bricks,
                                   const ParallelPolicy& policy, SpillFile& file) {
  const std::size_t block = block_bytes(bricks.size());
  const std::size_t record = record_bytes(points.scalar);
  std::vector<SpillList> lists(bricks.size());
  in_order<PlacedPoints>(
      points, policy,
      [&](const PointView& part, std::size_t first, PlacedPoints& placed) {
        place_points(part, points.first + first, bricks, placed);
      },
      [&](const PlacedPoints& placed) {
        for (std::size_t i = 0; i < placed.bricks.size(); ++i)
          lists[placed.bricks[i]].add(file, &placed.records[i * record], record, block);
      });
  for (SpillList& list : lists)
    list.finish(file);
  return lists;
}

}  // namespace

void check_stored(const ClusterOptions& options) {
  check(options);
  if (options.tolerance_per_metre > 0)
    throw std::invalid_argument("stored clusters have no tolerance_per_metre");
  if (options.oversized == Oversized::split)
    throw std::invalid_argument("stored clusters cannot be split: oversized must be drop or keep");
}

double halo_of(const ClusterOptions& options, ScalarType scalar) {
  const double r = options.tolerance;
  const double difference = scalar == ScalarType::float32 ? max_linked_difference(static_cast<float>(r * r))
                                                          : max_linked_difference(r * r);
  // The core condition of a point within one tolerance depends on points within two.
  return (options.min_points > 1 ? 2 : 1) * difference * (1 + 1e-6);
}

std::size_t bricks_at_a_time(const StoredClusterOptions& store, const ParallelPolicy& policy) {
  return std::clamp<std::size_t>(store.points_in_memory / kFewPoints, 1, thread_count(policy));
}

void divide(std::size_t points, const StoredClusterOptions& store, const ParallelPolicy& policy,
            Bricks& bricks) {
  // More bricks would need more memory for their lists than for their points.
  constexpr std::size_t max_bricks = 16'384;  // bricks have half to all of their points
  bricks.divide(
      std::max(store.points_in_memory / bricks_at_a_time(store, policy), points / (max_bricks / 2)));
}

std::size_t block_bytes(std::size_t bricks) {
  // The buffers of all lists have about 64 MiB together.
  return std::clamp<std::size_t>((64U << 20U) / (bricks + 1), 4096, 1U << 20U);
}

DistributedPoints distribute(const PointView& points, const ClusterOptions& options,
                             const StoredClusterOptions& store, const Execution& execution, SpillFile& file) {
  if (points.indices != nullptr) throw std::invalid_argument("stored clusters take no index list");
  DistributedPoints all{Bricks(BrickGrid(halo_of(options, points.scalar), kHalosPerCell)), {}, 0};
  all.invalid = count_cells(points, execution.parallel, all.bricks);
  divide(points.count, store, execution.parallel, all.bricks);
  all.lists = write_lists(points, all.bricks, execution.parallel, file);
  return all;
}

}  // namespace pcl_bv::detail
