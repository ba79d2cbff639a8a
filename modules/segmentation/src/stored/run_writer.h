// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Writes the points of bricks as runs of a share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "brick_clusters.h"
#include "brick_components.h"
#include "pcl_bv/segmentation/cluster_share.h"

namespace pcl_bv::detail {

/// Points near other shares are clustered again, cell by cell. Smaller cells make more runs.
inline constexpr double kHalosPerRunCell = 4;

/// Returns the grid for the cells of runs.
BrickGrid grid_of_runs(const ClusterOptions& options, ScalarType scalar);

/// The runs of a brick.
struct BrickRuns {
  std::vector<ShareRun> runs;  ///< With numbers of pieces as components, or kNoise.
  std::vector<ShareComponent> pieces;
  std::vector<std::uint8_t> is_complete;  ///< For each piece, whether all its points are in the brick.
};

/// Cells of the grid of bricks that are near other shares.
struct NearCells {
  BrickGrid grid;
  std::unordered_set<std::uint64_t> keys;  ///< BrickGrid::first_quarter() of the cells.
};

/// Records that follow one another in the brick and in a buffer.
struct WrittenRecords {
  std::uint64_t first_in_brick, first, count;
};

/// Makes runs of the brick whose components were found last, with all components as pieces.
class RunWriter {
 public:
  /// With `near`, a piece without points in these cells is one run. If it is complete or noise, its records
  /// are not written.
  RunWriter(const BrickComponents& components, const BrickGrid& grid, const std::optional<NearCells>& near)
      : components_(components), grid_(grid), near_(near) {}

  BrickRuns make(const std::vector<std::byte>& records);
  /// Returns the records to write. Valid until the next call.
  const std::vector<std::byte>& buffer() const { return buffer_; }
  const std::vector<WrittenRecords>& written() const { return written_; }

  /// Returns the complete pieces of allowed sizes, as views of packed points in the order of the cloud. Valid
  /// until the next call. `pieces` gets their numbers.
  std::vector<PointView> complete_pieces(const BrickRuns& brick, const std::vector<std::byte>& records,
                                         const ClusterOptions& options, std::vector<std::uint32_t>& pieces);

 private:
  void sort(const std::vector<std::byte>& records, std::size_t piece_count);
  std::uint32_t piece_of(std::size_t record) const;
  std::uint64_t cell_of(const PointView& view, std::size_t position) const;
  void find_cells(const PointView& view, std::size_t first, std::size_t end);
  void add_runs(const std::vector<std::byte>& records, std::size_t first, std::size_t end,
                std::uint32_t component, std::vector<ShareRun>& runs);

  const BrickComponents& components_;
  BrickGrid grid_;
  const std::optional<NearCells>& near_;
  std::vector<std::uint8_t> is_near_;  // for each piece, then for noise, whether it has points in near cells
  std::vector<std::uint64_t> cell_;    // for each record
  std::vector<std::uint32_t> order_;   // records by piece; noise is last
  std::vector<std::size_t> begin_;     // for each piece, in order_; then the ends of pieces and of noise
  std::vector<std::byte> buffer_, packed_;
  std::vector<WrittenRecords> written_;
};

}  // namespace pcl_bv::detail
