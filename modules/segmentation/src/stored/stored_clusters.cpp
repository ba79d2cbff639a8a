// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "pcl_bv/segmentation/stored_clusters.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "brick_clusters.h"
#include "brick_components.h"
#include "brick_workers.h"
#include "distributed_points.h"
#include "joined_pieces.h"
#include "lost_runs.h"
#include "merged_shares.h"
#include "pcl_bv/numeric/float_environment.h"
#include "run_labels.h"
#include "spill_file.h"

namespace pcl_bv::detail {
namespace {

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

// Finds and writes the components of bricks. Cannot be copied or moved.
class BrickWorker {
 public:
  BrickWorker(const DistributedPoints& all, ScalarType scalar, const ClusterOptions& options,
              const StoredClusterOptions& store, const Execution& execution, SpillFile& file,
              LabelFile* labels, std::vector<BrickResult>& results)
      : components_(all.bricks, scalar, options, PieceRule::shared, execution, file),
        clusters_(components_, options, store, execution, file, labels),
        results_(results) {}
  BrickWorker(const BrickWorker&) = delete;
  BrickWorker& operator=(const BrickWorker&) = delete;

  void operator()(std::uint32_t brick, const std::vector<std::byte>& records) {
    const std::size_t step = record_bytes(components_.scalar());
    components_.find(brick, records, step);
    results_[brick] = clusters_.write(brick, records, step);
  }

 private:
  BrickComponents components_;
  BrickClusters clusters_;
  std::vector<BrickResult>& results_;
};

}  // namespace

struct StoredClusters::State {
  explicit State(const std::filesystem::path& folder) : file(folder) {}

  SpillFile file;
  std::unique_ptr<LabelFile> labels;            // or null
  std::unique_ptr<ShareLabels> share_labels;    // or null
  std::vector<std::uint32_t> cluster_of_label;  // if there are labels
  ScalarType scalar = ScalarType::float32;
  std::vector<StoredCluster> clusters;
  Counts counts;
  std::size_t brick_count = 0;

  void add(const std::vector<BrickResult>& bricks, const ClusterOptions& options);
  void merge(const std::vector<const ClusterShare*>& shares, const LostRuns& lost,
             const ClusterOptions& options, const StoredClusterOptions& store, const Execution& execution);
  void add_pieces(const std::vector<BrickResult>& bricks, const ClusterOptions& options);
  void label(const std::vector<std::uint32_t>& piece_labels, const std::vector<std::uint32_t>& order,
             std::size_t first, std::size_t count);
  void sort();
};

void StoredClusters::State::add(const std::vector<BrickResult>& bricks, const ClusterOptions& options) {
  if (labels) cluster_of_label.assign(labels->label_count(), kNoCluster);
  for (const BrickResult& brick : bricks) {
    for (const StoredCluster& cluster : brick.clusters) {
      if (labels) cluster_of_label[cluster.label] = static_cast<std::uint32_t>(clusters.size());
      clusters.push_back(cluster);
    }
    counts.small += brick.counts.small;
    counts.large += brick.counts.large;
    counts.noise += brick.counts.noise;
  }
  add_pieces(bricks, options);
  sort();
}

// Sorts the clusters, and changes cluster_of_label accordingly.
void StoredClusters::State::sort() {
  for (std::size_t i = 0; i < clusters.size(); ++i)
    clusters[i].number = static_cast<std::uint32_t>(i);
  std::sort(clusters.begin(), clusters.end(), [](const StoredCluster& a, const StoredCluster& b) {
    return a.points != b.points ? a.points > b.points : a.first_number < b.first_number;
  });
  if (cluster_of_label.empty()) return;
  std::vector<std::uint32_t> position(clusters.size());
  for (std::size_t i = 0; i < clusters.size(); ++i)
    position[clusters[i].number] = static_cast<std::uint32_t>(i);
  for (std::uint32_t& cluster : cluster_of_label)
    if (cluster != kNoCluster) cluster = position[cluster];
}

// Tells that the pieces order[first] to order[first + count - 1] are the last cluster.
void StoredClusters::State::label(const std::vector<std::uint32_t>& piece_labels,
                                  const std::vector<std::uint32_t>& order, std::size_t first,
                                  std::size_t count) {
  for (std::size_t i = first; i < first + count && labels; ++i)
    cluster_of_label[piece_labels[order[i]]] = static_cast<std::uint32_t>(clusters.size() - 1);
}

// Adds the clusters that consist of pieces and have an allowed size. Counts the points of the others.
void StoredClusters::State::add_pieces(const std::vector<BrickResult>& bricks,
                                       const ClusterOptions& options) {
  std::vector<Piece> pieces;
  std::vector<SharedPoints> shared;
  std::vector<std::uint32_t> first_set, piece_labels;
  for (const BrickResult& brick : bricks) {
    shared.push_back(brick.shared);
    first_set.push_back(static_cast<std::uint32_t>(pieces.size()));
    pieces.insert(pieces.end(), brick.pieces.begin(), brick.pieces.end());
    for (std::uint32_t p = 0; p < brick.pieces.size() && labels; ++p)
      piece_labels.push_back(brick.first_label + p);
    if (pieces.size() > std::numeric_limits<std::uint32_t>::max())
      throw std::length_error("too many parts of clusters: use more memory");
  }
  UnionFind sets;
  sets.reset(pieces.size());
  join_pieces(shared, first_set, file, sets);
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
      label(piece_labels, order, i + 1 - of_cluster.size(), of_cluster.size());
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
  state_ = std::make_unique<State>(store.folder);
  State& state = *state_;
  state.scalar = points.scalar;
  if (store.has_labels) state.labels = std::make_unique<LabelFile>(store.folder, points.first + points.count);
  const DistributedPoints all = distribute(points, options, store, execution, state.file);
  state.counts.nonfinite = all.invalid;
  state.brick_count = all.bricks.size();
  std::vector<BrickResult> bricks(all.lists.size());
  for_each_brick(all.lists, store, execution, state.file, [&](const Execution& part) {
    return BrickWorker(all, points.scalar, options, store, part, state.file, state.labels.get(), bricks);
  });
  state.add(bricks, options);
}

StoredClusters::StoredClusters(const std::vector<const ClusterShare*>& shares, const ClusterOptions& options,
                               const StoredClusterOptions& store, const Execution& execution) {
  const FloatEnvironment environment;
  check_stored(options);
  LostRuns lost(shares.size());
  for (;;) {
    state_ = std::make_unique<State>(store.folder);
    try {
      state_->merge(shares, lost, options, store, execution);
      return;
    } catch (const ShareError& error) {
      const std::uint64_t points =
          store.on_lost && error.wrong_sum() ? lost.find(shares, error.share(), state_->file) : 0;
      if (points == 0) throw;
      store.on_lost(error, points);
    }
  }
}

void StoredClusters::State::merge(const std::vector<const ClusterShare*>& shares, const LostRuns& lost,
                                  const ClusterOptions& options, const StoredClusterOptions& store,
                                  const Execution& execution) {
  if (store.has_labels) share_labels = std::make_unique<ShareLabels>(store.folder, store.points_of_shares);
  MergedShares merged(shares, lost, options, store, execution, file, share_labels.get());
  if (!shares.empty()) scalar = shares.front()->scalar();
  clusters = merged.take_clusters();
  cluster_of_label = merged.take_cluster_of_label();
  counts = merged.counts();
  brick_count = merged.brick_count();
  sort();
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

std::size_t StoredClusters::first_number(std::size_t cluster) const {
  return state_->clusters[cluster].first_number;
}

std::optional<StoredVisit> StoredClusters::visit(std::size_t cluster) const {
  return state_->clusters[cluster].visit;
}

std::vector<std::uint32_t> StoredClusters::labels(std::size_t first, std::size_t count) const {
  const State& state = *state_;
  if (!state.labels && !state.share_labels) throw std::logic_error("labels were not requested");
  std::vector<std::uint32_t> labels =
      (state.labels ? *state.labels : state.share_labels->labels).read(first, count);
  for (std::uint32_t& label : labels)
    label = label == 0 ? kNoCluster : state.cluster_of_label[label];
  return labels;
}

std::vector<std::uint32_t> StoredClusters::check_sums(std::size_t first, std::size_t count) const {
  if (!state_->share_labels) throw std::logic_error("labels of shares were not requested");
  return state_->share_labels->check_sums.read(first, count);
}

std::optional<ComponentOfShare> StoredClusters::component(std::size_t cluster) const {
  return state_->clusters[cluster].component;
}

bool StoredClusters::is_incomplete(std::size_t cluster) const {
  return state_->clusters[cluster].incomplete;
}

const Counts& StoredClusters::counts() const {
  return state_->counts;
}

StoredClusters::Points StoredClusters::points(std::size_t cluster) const {
  const State& state = *state_;
  const StoredCluster& stored = state.clusters[cluster];
  if (stored.offset == StoredCluster::kNoPoints)
    throw std::logic_error("the points of this cluster were not kept");
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
