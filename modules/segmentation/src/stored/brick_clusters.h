// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes the points of the components of bricks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "brick_components.h"
#include "label_file.h"
#include "pcl_bv/segmentation/cluster_share.h"
#include "pcl_bv/segmentation/clusters.h"
#include "pcl_bv/segmentation/stored_clusters.h"
#include "spill_file.h"

namespace pcl_bv::detail {

/// Returns whether clusters of this number of points are in the result.
inline bool is_size_allowed(const ClusterOptions& options, std::uint64_t points) {
  return points >= options.min_size && (points <= options.max_size || options.oversized == Oversized::keep);
}

/// Adds `added` points of a cluster that has a number of points that is not allowed.
inline void count_dropped(const ClusterOptions& options, std::uint64_t added, std::uint64_t points,
                          Counts& counts) {
  (points < options.min_size ? counts.small : counts.large) += added;
}

/// A cluster whose points are in the temporary file, coordinates only, or were visited.
struct StoredCluster {
  static constexpr std::uint64_t kNoPoints = ~std::uint64_t{0};  ///< As offset: the points were not written.

  std::uint64_t offset, points;
  std::uint64_t first_number;  ///< Smallest number of its points.
  std::optional<StoredVisit> visit{};
  std::uint32_t label = 0;                      ///< Label of its points (LabelFile), if it is in one brick.
  std::uint32_t number = 0;                     ///< Position before sorting.
  std::optional<ComponentOfShare> component{};  ///< If it is a component of a share.
  bool incomplete = false;                      ///< Whether it may lack points that are lost.
};

/// A run of a share.
struct PieceOfShare {
  const ClusterShare* share = nullptr;
  std::size_t number = 0;       ///< Of the share, among the shares that are merged.
  std::uint32_t check_sum = 0;  ///< ShareRun::check_sum.
};

/// The points of a piece, as records in the temporary file or in a share.
struct Piece {
  std::uint64_t offset, points;
  PieceOfShare from{};
};

/// The result of a brick.
struct BrickResult {
  std::vector<StoredCluster> clusters;  ///< Clusters of allowed sizes with all their points in the brick.
  std::vector<Piece> pieces;
  SharedPoints shared;
  std::uint32_t first_label = 0;  ///< Label of the points of the first piece; others follow.
  Counts counts;  ///< Points of noise, and of clusters in the brick that are dropped because of their size.
};

/// Writes the points of bricks. Several objects may write to the same file at the same time.
class BrickClusters {
 public:
  /// `visit` and `keep_visited` are those of StoredClusterOptions.
  BrickClusters(const BrickComponents& components, const ClusterOptions& options,
                const StoredClusterOptions& store, const Execution& execution, SpillFile& file,
                LabelFile* labels = nullptr)
      : components_(components),
        options_(options),
        store_(store),
        execution_(execution),
        file_(file),
        labels_(labels) {}

  /// Writes the brick whose components were found last.
  BrickResult write(std::uint32_t brick, const std::vector<std::byte>& records, std::size_t step);

 private:
  /// Returns the number of complete clusters of allowed sizes.
  std::size_t make_room(std::vector<Piece>& pieces);
  void write_clusters(std::uint32_t brick, std::vector<StoredCluster>& clusters);

  const BrickComponents& components_;
  ClusterOptions options_;
  const StoredClusterOptions& store_;
  Execution execution_;
  SpillFile& file_;
  LabelFile* labels_;                 // or null
  std::vector<std::uint64_t> next_;   // for each component, the position of its next point in a buffer
  std::vector<std::uint32_t> label_;  // for each component; 0 before its first point is written
  std::vector<std::byte> points_of_clusters_, points_of_pieces_;  // buffers
};

}  // namespace pcl_bv::detail
