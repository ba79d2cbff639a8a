// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#include "merged_shares.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "brick_workers.h"
#include "joined_pieces.h"
#include "piece_reader.h"
#include "run_writer.h"

namespace pcl_bv::detail {
namespace {

constexpr std::size_t kRunBytes = 1U << 20U;  // of a run at a time

// Returns the list that has an item, and the position of the item in it. Items are numbered over all lists;
// `firsts` has the number of the first item of each list.
std::pair<std::size_t, std::uint32_t> list_and_position(const std::vector<std::uint32_t>& firsts,
                                                        std::uint32_t item) {
  const auto after = std::upper_bound(firsts.begin(), firsts.end(), item);
  const auto list = static_cast<std::size_t>(after - firsts.begin()) - 1;
  return {list, item - firsts[list]};
}

}  // namespace

MergedShares::MergedShares(const std::vector<const ClusterShare*>& shares, const LostRuns& lost,
                           const ClusterOptions& options, const StoredClusterOptions& store,
                           const Execution& execution, SpillFile& file, ShareLabels* labels)
    : shares_(shares),
      lost_(lost),
      options_(options),
      store_(store),
      file_(file),
      labels_(labels),
      scalar_(ScalarType::float32) {
  if (!shares.empty()) scalar_ = shares.front()->scalar();
  std::size_t components = 0;
  for (const ClusterShare* share : shares) {
    if (share->scalar() != scalar_) throw std::invalid_argument("shares have float and double points");
    first_component_.push_back(static_cast<std::uint32_t>(components));
    components += share->components().size();
    if (components >= kMaxSets) throw std::length_error("too many clusters in the shares");
  }
  passive_points_.assign(components, 0);
  is_near_lost_.assign(components, 0);
  Bricks bricks(grid_of_runs(options, scalar_));
  cells_ = find_active_cells(shares);
  count_runs(execution.parallel, bricks);
  std::vector<SpillList> lists(bricks.size());
  distribute(bricks, lists);
  cluster_active(bricks, lists, execution);
  label(execution.parallel);
  join();
}

// Counts the points of active cells in bricks, and those of passive cells in components.
void MergedShares::count_runs(const ParallelPolicy& policy, Bricks& bricks) {
  std::uint64_t active_points = 0;
  first_run_.assign(passive_points_.size() + 1, 0);
  for (std::size_t s = 0; s < shares_.size(); ++s) {
    for (std::size_t r = 0; r < shares_[s]->runs().size(); ++r) {
      const ShareRun& run = shares_[s]->runs()[r];
      if (run.component != ShareRun::kNoise && lost_.is_near(run.cell))
        is_near_lost_[component_number(s, run.component)] = 1;
      if (lost_.contains(s, r)) continue;
      if (is_active(run)) {
        bricks.count(run.cell, run.points);
        active_points += run.points;
      } else if (run.component == ShareRun::kNoise) {
        counts_.noise += run.points;
      } else {
        passive_points_[component_number(s, run.component)] += run.points;
        ++first_run_[component_number(s, run.component) + 1];
      }
    }
  }
  divide(active_points, store_, policy, bricks);
  for (std::size_t c = 1; c < first_run_.size(); ++c)
    first_run_[c] += first_run_[c - 1];
  passive_runs_.resize(first_run_.back());
  std::vector<std::uint64_t> next(first_run_.begin(), first_run_.end() - 1);
  for (std::uint32_t s = 0; s < shares_.size(); ++s) {
    std::uint64_t offset = 0;
    for (std::uint32_t r = 0; r < shares_[s]->runs().size(); ++r) {
      const ShareRun& run = shares_[s]->runs()[r];
      if (run.component != ShareRun::kNoise && !is_active(run) && !lost_.contains(s, r))
        passive_runs_[next[component_number(s, run.component)]++] = {s, r, offset};
      offset += run.points * record_bytes(scalar_);
    }
  }
}

void MergedShares::distribute(const Bricks& bricks, std::vector<SpillList>& lists) {
  const std::size_t block = block_bytes(lists.size());
  for (std::uint32_t s = 0; s < shares_.size() && !lists.empty(); ++s) {
    std::uint64_t offset = 0;
    for (std::uint32_t r = 0; r < shares_[s]->runs().size(); ++r) {
      const ShareRun& run = shares_[s]->runs()[r];
      const auto kind = cells_.find(run.cell);
      if (kind != cells_.end() && !lost_.contains(s, r))
        add_points_of_run({s, r, offset}, kind->second == CellKind::active, bricks, block, lists);
      offset += run.points * record_bytes(scalar_);
    }
  }
  for (SpillList& list : lists)
    list.finish(file_);
}

void MergedShares::add_points_of_run(const RunPosition& position, bool active, const Bricks& bricks,
                                     std::size_t block, std::vector<SpillList>& lists) {
  const ClusterShare& share = *shares_[position.share];
  const ShareRun& run = share.runs()[position.run];
  const std::uint32_t component =
      (run.component == ShareRun::kNoise ? kNoComponent : component_number(position.share, run.component)) |
      (lost_.is_near(run.cell) ? kNearLost : 0);
  const std::uint64_t end = labels_ == nullptr ? kNumberMask + 1 : std::min(labels_->points, kNumberMask + 1);
  PieceReader reader(file_, {position.offset, run.points, {&share, position.share, run.check_sum}}, scalar_,
                     kRunBytes);
  std::byte record[record_bytes(ScalarType::float64) + sizeof component];
  const std::size_t size = point_bytes(scalar_);
  PointView view = view_of_records({}, record_bytes(scalar_), scalar_);
  view.count = 1;
  Bricks::Cursor cursor;
  for (; !reader.done(); reader.next()) {
    view.data = reader.record();
    const Coordinates point = load_point(view, 0);
    if (!is_valid(point)) throw ShareError(position.share, "has points that are not finite");
    if (reader.number() >= end) throw ShareError(position.share, "has numbers of points that are too large");
    const Bricks::Place at = bricks.place(point, cursor);
    const std::uint64_t number = reader.number() | (number_of_record(reader.record(), scalar_) & kCore);
    const auto add = [&](std::uint32_t brick, std::uint64_t mark) {
      const std::uint64_t marked = number | mark;
      std::memcpy(record, reader.record(), size);
      std::memcpy(record + size, &marked, sizeof marked);
      std::memcpy(record + size + sizeof marked, &component, sizeof component);
      lists[brick].add(file_, record, active_record_bytes(scalar_), block);
    };
    if (active) {
      if (at.own == Bricks::kNone) throw ShareError(position.share, "its cells do not have its points");
      add(at.own, at.others > 0 ? kInOtherBricks : 0);
    }
    for (std::uint32_t o = 0; o < at.others; ++o)
      add(at.other[o], kOfOtherBrick);
  }
}

void MergedShares::cluster_active(const Bricks& bricks, const std::vector<SpillList>& lists,
                                  const Execution& execution) {
  bricks_.resize(lists.size());
  for_each_brick(lists, store_, execution, file_, [&](const Execution& part) {
    return ActiveWorker(bricks, scalar_, options_, part, file_,
                        labels_ == nullptr ? nullptr : &labels_->labels, bricks_);
  });
}

// Labels the points of components. Those of active cells have the labels of pieces.
void MergedShares::label(const ParallelPolicy& policy) {
  if (labels_ == nullptr) return;
  first_label_ = labels_->labels.take(passive_points_.size());
  cluster_of_label_.assign(labels_->labels.label_count(), StoredClusters::kNoCluster);
  const auto label_of = [&](std::uint32_t share, std::uint32_t number) -> std::optional<std::uint32_t> {
    const ShareRun& run = shares_[share]->runs()[number];
    if (lost_.contains(share, number)) return std::nullopt;
    if (run.component == ShareRun::kNoise || is_active(run)) return 0;
    return first_label_ + component_number(share, run.component);
  };
  const std::size_t points_at_a_time =
      std::clamp(store_.points_in_memory / thread_count(policy), std::size_t{1} << 14, std::size_t{1} << 20);
  label_runs(shares_, label_of, {policy, points_at_a_time}, file_, *labels_);
}

void MergedShares::join() {
  std::size_t sets_count = passive_points_.size();
  std::vector<SharedPoints> shared;
  for (const ActiveBrick& brick : bricks_) {
    first_piece_.push_back(static_cast<std::uint32_t>(sets_count));
    shared.push_back(brick.result.shared);
    sets_count += brick.result.pieces.size();
    counts_.noise += brick.result.counts.noise;
    if (sets_count >= kMaxSets) throw std::length_error("too many parts of clusters: use more memory");
  }
  UnionFind sets;
  sets.reset(sets_count);
  join_pieces(shared, first_piece_, file_, sets);
  for (std::size_t b = 0; b < bricks_.size(); ++b) {
    for (const auto& [component, piece] : bricks_[b].links)
      sets.unite(component, first_piece_[b] + piece);
  }
  const std::vector<std::uint32_t>& roots = sets.roots();
  const std::vector<std::uint32_t> order = order_by_root(roots);
  std::vector<std::uint32_t> group;
  for (std::size_t i = 0; i < order.size(); ++i) {
    group.push_back(order[i]);
    if (i + 1 < order.size() && roots[order[i]] == roots[order[i + 1]]) continue;
    add_group(group);
    group.clear();
  }
}

// Adds the cluster of components and pieces, or counts its points. Components of a group come first.
void MergedShares::add_group(const std::vector<std::uint32_t>& group) {
  std::uint64_t points = 0;
  std::uint32_t only = kNoComponent;  // the component that has all points so far
  const auto add = [&](std::uint32_t component, std::uint64_t count) {
    if (count == 0) return;
    only = points == 0 || only == component ? component : kNoComponent;
    points += count;
  };
  for (const std::uint32_t set : group) {
    if (set < passive_points_.size()) {
      add(set, passive_points_[set]);
    } else {
      const auto [brick, piece] = list_and_position(first_piece_, set);
      add(bricks_[brick].component[piece], bricks_[brick].result.pieces[piece].points);
    }
  }
  if (points == 0) return;
  if (!is_size_allowed(options_, points)) return count_dropped(options_, points, points, counts_);
  add_cluster(group, only, points);
}

// `only` is the component that has all points of the cluster, if it is a component.
void MergedShares::add_cluster(const std::vector<std::uint32_t>& group, std::uint32_t only,
                               std::uint64_t points) {
  std::optional<ComponentOfShare> component;
  StoredCluster cluster{StoredCluster::kNoPoints, points, 0};
  if (only < passive_points_.size()) {
    const auto [share, number] = list_and_position(first_component_, only);
    const ShareComponent& whole = shares_[share]->components()[number];
    if (whole.points == points) component = {share, number};
    cluster.first_number = whole.first_number + shares_[share]->first_number;
  }
  const bool known = component && store_.is_known && store_.is_known(*component);
  if (!known) cluster = merge_pieces(pieces_of(group), scalar_, file_);
  cluster.component = component;
  cluster.incomplete = is_incomplete(group);
  clusters_.push_back(cluster);
  if (labels_ != nullptr) label_group(group);
}

// Tells that the labels of components and pieces are those of the last cluster.
void MergedShares::label_group(const std::vector<std::uint32_t>& group) {
  for (const std::uint32_t set : group) {
    std::uint32_t label = first_label_ + set;
    if (set >= passive_points_.size()) {
      const auto [brick, piece] = list_and_position(first_piece_, set);
      label = bricks_[brick].result.first_label + piece;
    }
    cluster_of_label_[label] = static_cast<std::uint32_t>(clusters_.size() - 1);
  }
}

bool MergedShares::is_incomplete(const std::vector<std::uint32_t>& group) const {
  return std::any_of(group.begin(), group.end(), [&](std::uint32_t set) {
    if (set < is_near_lost_.size()) return is_near_lost_[set] != 0;
    const auto [brick, piece] = list_and_position(first_piece_, set);
    return bricks_[brick].is_near_lost[piece] != 0;
  });
}

std::vector<Piece> MergedShares::pieces_of(const std::vector<std::uint32_t>& group) const {
  std::vector<Piece> pieces;
  for (const std::uint32_t set : group) {
    if (set >= passive_points_.size()) {
      const auto [brick, piece] = list_and_position(first_piece_, set);
      pieces.push_back(bricks_[brick].result.pieces[piece]);
      continue;
    }
    for (std::uint64_t i = first_run_[set]; i < first_run_[set + 1]; ++i) {
      const RunPosition& position = passive_runs_[i];
      const ShareRun& run = shares_[position.share]->runs()[position.run];
      pieces.push_back(
          {position.offset, run.points, {shares_[position.share], position.share, run.check_sum}});
    }
  }
  return pieces;
}

}  // namespace pcl_bv::detail
