// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes the points of the components of bricks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "brick_components.h"
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
  std::uint64_t offset, points;
  std::uint64_t first_number;  ///< Smallest number of its points.
  std::size_t visit = StoredClusters::kNotVisited;
};

/// The points of a piece, as records in the temporary file.
struct Piece {
  std::uint64_t offset, points;
};

class BrickClusters {
 public:
  /// `visit` and `keep_visited` are those of StoredClusterOptions.
  BrickClusters(const BrickComponents& components, const ClusterOptions& options,
                const StoredClusterOptions& store, SpillFile& file)
      : components_(components), options_(options), store_(store), file_(file) {}

  /// Adds the brick that was added to the components last, with its records.
  void add(const std::vector<std::byte>& records, std::size_t step);

  /// Clusters with all their points in one brick. To be called once.
  std::vector<StoredCluster> take_clusters() { return std::move(clusters_); }

  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Points of clusters in one brick that are dropped because of their size.
  const Counts& counts() const { return counts_; }

 private:
  void make_room();
  void write_clusters(std::size_t first);

  const BrickComponents& components_;
  ClusterOptions options_;
  const StoredClusterOptions& store_;
  SpillFile& file_;
  std::vector<std::uint64_t> next_;  // for each component, the position of its next point in a buffer
  std::vector<std::uint32_t> seen_;  // for each component, whether it is in clusters_
  std::vector<std::byte> points_of_clusters_, points_of_pieces_;  // buffers
  std::vector<StoredCluster> clusters_;
  std::vector<Piece> pieces_;
  std::size_t visited_ = 0;
  Counts counts_;
};

}  // namespace pcl_bv::detail
