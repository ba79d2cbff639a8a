// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Joins the components of shares.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "active_brick.h"
#include "active_cells.h"
#include "brick_clusters.h"
#include "distributed_points.h"
#include "lost_runs.h"
#include "pcl_bv/segmentation/cluster_share.h"
#include "run_labels.h"
#include "union_find.h"

namespace pcl_bv::detail {

/// Merges the components of shares. In a cell that has points of one share around it only, the components of
/// that share are right. The points of all other cells ("active" cells) are clustered again, with those of
/// all shares that can affect them. Components of the shares are then joined with the pieces of these
/// clusters that have a core point in common.
class MergedShares {
 public:
  /// Leaves out lost runs. Clusters near them may lack points and are incomplete. `labels` may be null.
  MergedShares(const std::vector<const ClusterShare*>& shares, const LostRuns& lost,
               const ClusterOptions& options, const StoredClusterOptions& store, const Execution& execution,
               SpillFile& file, ShareLabels* labels = nullptr);

  /// Clusters of allowed sizes.
  std::vector<StoredCluster> take_clusters() { return std::move(clusters_); }
  /// For each label, the number of its cluster in take_clusters(), or StoredClusters::kNoCluster.
  std::vector<std::uint32_t> take_cluster_of_label() { return std::move(cluster_of_label_); }
  const Counts& counts() const { return counts_; }
  std::size_t brick_count() const { return bricks_.size(); }

 private:
  // A run, and the share that has it.
  struct RunPosition {
    std::uint32_t share;
    std::uint32_t run;
    std::uint64_t offset;  // of its first byte in the share
  };

  void count_runs(const ParallelPolicy& policy, Bricks& bricks);
  void distribute(const Bricks& bricks, std::vector<SpillList>& lists);
  void add_points_of_run(const RunPosition& position, bool active, const Bricks& bricks, std::size_t block,
                         std::vector<SpillList>& lists);
  void cluster_active(const Bricks& bricks, const std::vector<SpillList>& lists, const Execution& execution);
  void join();
  void label(const ParallelPolicy& policy);
  void add_group(const std::vector<std::uint32_t>& group);
  void add_cluster(const std::vector<std::uint32_t>& group, std::uint32_t only, std::uint64_t points);
  void label_group(const std::vector<std::uint32_t>& group);
  bool is_incomplete(const std::vector<std::uint32_t>& group) const;
  std::vector<Piece> pieces_of(const std::vector<std::uint32_t>& group) const;
  std::uint32_t component_number(std::size_t share, std::uint32_t component) const {
    return first_component_[share] + component;
  }
  bool is_active(const ShareRun& run) const {
    const auto found = cells_.find(run.cell);
    return found != cells_.end() && found->second == CellKind::active;
  }

  const std::vector<const ClusterShare*>& shares_;
  const LostRuns& lost_;
  ClusterOptions options_;
  const StoredClusterOptions& store_;
  SpillFile& file_;
  ShareLabels* labels_;  // or null
  ScalarType scalar_;
  std::unordered_map<std::uint64_t, CellKind> cells_;
  std::vector<std::uint32_t> first_component_;  // of each share, among all components
  std::vector<std::uint64_t> passive_points_;   // of each component
  std::vector<std::uint8_t> is_near_lost_;      // for each component, whether it has points near lost ones
  std::vector<RunPosition> passive_runs_;       // by component
  std::vector<std::uint64_t> first_run_;        // of each component, in passive_runs_; then their number
  std::vector<ActiveBrick> bricks_;
  std::vector<std::uint32_t> first_piece_;  // of each brick, among all sets; components come first
  std::vector<StoredCluster> clusters_;
  std::uint32_t first_label_ = 0;                // of the components
  std::vector<std::uint32_t> cluster_of_label_;  // if there are labels
  Counts counts_;
};

}  // namespace pcl_bv::detail
