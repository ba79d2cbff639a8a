// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Clusters again the points of shares that are near other shares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "brick_clusters.h"
#include "pcl_bv/segmentation/stored_clusters.h"

namespace pcl_bv::detail {

/// The result of a brick with points near other shares.
struct ActiveBrick {
  BrickResult result;
  /// Components of shares that have a core point in common with a piece of the brick, and the piece.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  /// For each piece, the component of all its points in their shares, or kNoComponent.
  std::vector<std::uint32_t> component;
  std::vector<std::uint8_t> is_near_lost;  ///< For each piece, whether it has points near lost ones.
};

/// Components of shares, and pieces after them, have smaller numbers.
inline constexpr std::uint32_t kMaxSets = (std::uint32_t{1} << 31) - 2;
/// As a component: none, or several.
inline constexpr std::uint32_t kNoComponent = kMaxSets + 1;
/// Set in the component of a record that is near lost points.
inline constexpr std::uint32_t kNearLost = std::uint32_t{1} << 31;

/// Returns the size of a record near other shares: a record as in bricks, and the component of the point in
/// its share, among the components of all shares, or kNoComponent.
constexpr std::size_t active_record_bytes(ScalarType scalar) {
  return record_bytes(scalar) + sizeof(std::uint32_t);
}

/// Clusters the points of bricks with such records.
class ActiveWorker {
 public:
  ActiveWorker(const Bricks& bricks, ScalarType scalar, const ClusterOptions& options,
               const Execution& execution, SpillFile& file, LabelFile* labels,
               std::vector<ActiveBrick>& results)
      : components_(bricks, scalar, options, PieceRule::all, execution, file),
        clusters_(components_, options, store_, execution, file, labels),
        results_(results) {}
  ActiveWorker(const ActiveWorker&) = delete;
  ActiveWorker& operator=(const ActiveWorker&) = delete;

  void operator()(std::uint32_t number, const std::vector<std::byte>& unsorted);

 private:
  void add_links(const std::vector<std::byte>& records, std::size_t step, ActiveBrick& brick);

  StoredClusterOptions store_;
  BrickComponents components_;
  BrickClusters clusters_;
  std::vector<ActiveBrick>& results_;
};

}  // namespace pcl_bv::detail
