// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/stored_clusters.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "brick_clusters.h"
#include "brick_components.h"
#include "bricks.h"
#include "components.h"
#include "joined_pieces.h"
#include "pcl_bv/numeric/float_environment.h"
#include "pcl_bv/parallel/for_each_chunk.h"
#include "spill_file.h"

namespace pcl_bv::detail {
namespace {

// A larger number makes fewer cells, with more points near their borders.
constexpr double kHalosPerCell = 16;

// The points of one cluster in the temporary file.
class SpillSource final : public PointSource {
 public:
  SpillSource(const SpillFile& file, const StoredCluster& cluster, ScalarType scalar)
      : file_(file), cluster_(cluster), scalar_(scalar) {}

  PointView load(std::size_t first, std::size_t count, std::vector<std::byte>& buffer) const override {
    const std::size_t step = point_bytes(scalar_);
    if (buffer.size() < count * step) buffer.resize(count * step);
    file_.read(cluster_.offset + first * step, buffer.data(), count * step);
    return packed_points(buffer.data(), scalar_, count, first);
  }

 private:
  const SpillFile& file_;
  StoredCluster cluster_;
  ScalarType scalar_;
};

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
    if (place.own == Bricks::kNone) throw std::runtime_error("the points have changed while they were read");
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
std::vector<SpillList> distribute(const PointView& points, const Bricks& bricks, const ParallelPolicy& policy,
                                  SpillFile& file) {
  // The buffers of all lists have about 64 MiB together.
  const std::size_t block = std::clamp<std::size_t>((64U << 20U) / (bricks.size() + 1), 4096, 1U << 20U);
  const std::size_t record = record_bytes(points.scalar);
  std::vector<SpillList> lists(bricks.size());
  in_order<PlacedPoints>(
      points, policy,
      [&](const PointView& part, std::size_t first, PlacedPoints& placed) {
        place_points(part, first, bricks, placed);
      },
      [&](const PlacedPoints& placed) {
        for (std::size_t i = 0; i < placed.bricks.size(); ++i)
          lists[placed.bricks[i]].add(file, &placed.records[i * record], record, block);
      });
  for (SpillList& list : lists)
    list.finish(file);
  return lists;
}

// Bricks with fewer points have too many points of their neighbours.
constexpr std::size_t kFewPoints = 1U << 18U;

std::size_t bricks_at_a_time(const StoredClusterOptions& store, const ParallelPolicy& policy) {
  return std::clamp<std::size_t>(store.points_in_memory / kFewPoints, 1, thread_count(policy));
}

// Clusters the points of all bricks. Several bricks are in memory at a time, each for one thread.
std::vector<BrickResult> work_on(const Bricks& bricks, const std::vector<SpillList>& lists, ScalarType scalar,
                                 const ClusterOptions& options, const StoredClusterOptions& store,
                                 const Execution& execution, SpillFile& file) {
  const std::size_t workers = std::min(bricks_at_a_time(store, execution.parallel), lists.size());
  const Execution of_worker = workers > 1 ? Execution{Serial{}, execution.isa} : execution;
  std::vector<BrickResult> results(lists.size());
  std::atomic<std::size_t> next = 0;
  for_each_chunk(workers > 1 ? execution.parallel : ParallelPolicy{Serial{}}, workers, [&](std::size_t) {
    BrickComponents components(bricks, scalar, options, PieceRule::shared, of_worker, file);
    BrickClusters clusters(components, options, store, of_worker, file);
    std::vector<std::byte> records;
    for (std::size_t i = next++; i < lists.size(); i = next++) {
      const auto brick = static_cast<std::uint32_t>(i);
      lists[i].read(file, records);
      lists[i].discard(file);
      components.find(brick, records, record_bytes(scalar));
      results[i] = clusters.write(brick, records, record_bytes(scalar));
    }
  });
  return results;
}

}  // namespace

struct StoredClusters::State {
  explicit State(const std::filesystem::path& folder) : file(folder) {}

  SpillFile file;
  ScalarType scalar = ScalarType::float32;
  std::vector<StoredCluster> clusters;
  Counts counts;
  std::size_t brick_count = 0;

  void add(const std::vector<BrickResult>& bricks, const ClusterOptions& options);
  void add_pieces(const std::vector<BrickResult>& bricks, const ClusterOptions& options);
};

void StoredClusters::State::add(const std::vector<BrickResult>& bricks, const ClusterOptions& options) {
  for (const BrickResult& brick : bricks) {
    clusters.insert(clusters.end(), brick.clusters.begin(), brick.clusters.end());
    counts.small += brick.counts.small;
    counts.large += brick.counts.large;
    counts.noise += brick.counts.noise;
  }
  add_pieces(bricks, options);
  std::sort(clusters.begin(), clusters.end(), [](const StoredCluster& a, const StoredCluster& b) {
    return a.points != b.points ? a.points > b.points : a.first_number < b.first_number;
  });
}

// Adds the clusters that consist of pieces and have an allowed size. Counts the points of the others.
void StoredClusters::State::add_pieces(const std::vector<BrickResult>& bricks,
                                       const ClusterOptions& options) {
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> first_set;
  for (const BrickResult& brick : bricks) {
    first_set.push_back(static_cast<std::uint32_t>(pieces.size()));
    pieces.insert(pieces.end(), brick.pieces.begin(), brick.pieces.end());
    if (pieces.size() > std::numeric_limits<std::uint32_t>::max())
      throw std::length_error("too many parts of clusters: use more memory");
  }
  UnionFind sets;
  sets.reset(pieces.size());
  join_pieces(bricks, first_set, file, sets);
  const std::vector<std::uint32_t>& roots = sets.roots();
  const std::vector<std::uint32_t> order = order_by_root(roots);
  std::vector<Piece> of_cluster;
  for (std::size_t i = 0; i < order.size(); ++i) {
    of_cluster.push_back(pieces[order[i]]);
    if (i + 1 < order.size() && roots[order[i]] == roots[order[i + 1]]) continue;
    std::uint64_t points = 0;
    for (const Piece& piece : of_cluster)
      points += piece.points;
    if (is_size_allowed(options, points)) {
      clusters.push_back(merge_pieces(of_cluster, scalar, file));
    } else {
      count_dropped(options, points, points, counts);
    }
    of_cluster.clear();
  }
}

StoredClusters::StoredClusters(const PointView& points, const ClusterOptions& options,
                               const StoredClusterOptions& store, const Execution& execution) {
  const FloatEnvironment environment;
  check_stored(options);
  if (points.indices != nullptr) throw std::invalid_argument("stored clusters take no index list");
  state_ =
      std::make_unique<State>(store.folder.empty() ? std::filesystem::temp_directory_path() : store.folder);
  State& state = *state_;
  state.scalar = points.scalar;
  Bricks bricks(BrickGrid(halo_of(options, points.scalar), kHalosPerCell));
  state.counts.nonfinite = count_cells(points, execution.parallel, bricks);
  // More bricks would need more memory for their lists than for their points.
  constexpr std::size_t max_bricks = 16'384;
  bricks.divide(std::max(store.points_in_memory / bricks_at_a_time(store, execution.parallel),
                         points.count / max_bricks));
  state.brick_count = bricks.size();
  const std::vector<SpillList> lists = distribute(points, bricks, execution.parallel, state.file);
  state.add(work_on(bricks, lists, points.scalar, options, store, execution, state.file), options);
}

StoredClusters::~StoredClusters() = default;
StoredClusters::StoredClusters(StoredClusters&&) noexcept = default;
StoredClusters& StoredClusters::operator=(StoredClusters&&) noexcept = default;

std::size_t StoredClusters::size() const {
  return state_->clusters.size();
}

std::size_t StoredClusters::brick_count() const {
  return state_->brick_count;
}

std::size_t StoredClusters::point_count(std::size_t cluster) const {
  return state_->clusters[cluster].points;
}

std::optional<StoredVisit> StoredClusters::visit(std::size_t cluster) const {
  return state_->clusters[cluster].visit;
}

const Counts& StoredClusters::counts() const {
  return state_->counts;
}

StoredClusters::Points StoredClusters::points(std::size_t cluster) const {
  const State& state = *state_;
  const StoredCluster& stored = state.clusters[cluster];
  Points points;
  if (stored.points <= kChunkPoints) {
    points.bytes_.resize(point_bytes(state.scalar) * stored.points);
    state.file.read(stored.offset, points.bytes_.data(), points.bytes_.size());
    points.view_ = packed_points(points.bytes_.data(), state.scalar, stored.points);
  } else {
    points.source_ = std::make_unique<SpillSource>(state.file, stored, state.scalar);
    points.view_ = view_of(*points.source_, stored.points, state.scalar);
  }
  return points;
}

}  // namespace pcl_bv::detail
