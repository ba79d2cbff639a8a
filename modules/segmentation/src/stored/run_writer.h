// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes the points of bricks as runs of a share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "brick_clusters.h"
#include "brick_components.h"
#include "pcl_bv/segmentation/cluster_share.h"

namespace pcl_bv::detail {

/// Returns the grid for the cells of runs.
BrickGrid grid_of_runs(const ClusterOptions& options, ScalarType scalar);

/// The runs of a brick.
struct BrickRuns {
  Extent records;
  std::vector<ShareRun> runs;  ///< With numbers of pieces as components, or kNoise.
  std::vector<ShareComponent> pieces;
  std::vector<std::uint8_t> is_complete;  ///< For each piece, whether all its points are in the brick.
};

/// Writes the brick whose components were found last, with all components as pieces.
class RunWriter {
 public:
  RunWriter(const BrickComponents& components, const BrickGrid& grid, SpillFile& file)
      : components_(components), grid_(grid), file_(file) {}

  BrickRuns write(const std::vector<std::byte>& records);

  /// Returns the complete pieces of allowed sizes, as views of packed points in the order of the cloud. Valid
  /// until the next call. `pieces` gets their numbers.
  std::vector<PointView> complete_pieces(const BrickRuns& brick, const std::vector<std::byte>& records,
                                         const ClusterOptions& options, std::vector<std::uint32_t>& pieces);

 private:
  void sort(const std::vector<std::byte>& records, std::size_t piece_count);
  std::uint32_t piece_of(std::size_t record) const;
  void add_runs(const std::vector<std::byte>& records, std::size_t first, std::size_t end,
                std::uint32_t component, std::vector<ShareRun>& runs);

  const BrickComponents& components_;
  BrickGrid grid_;
  SpillFile& file_;
  std::vector<std::uint64_t> cell_;   // for each record
  std::vector<std::uint32_t> order_;  // records by piece; noise is last
  std::vector<std::size_t> begin_;    // for each piece, in order_; then the ends of pieces and of noise
  std::vector<std::byte> written_, packed_;
};

}  // namespace pcl_bv::detail
