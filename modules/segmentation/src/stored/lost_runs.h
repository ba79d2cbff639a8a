// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs of shares whose points are damaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "pcl_bv/segmentation/cluster_share.h"
#include "spill_file.h"

namespace pcl_bv::detail {

class LostRuns {
 public:
  explicit LostRuns(std::size_t shares) : lost_(shares) {}

  /// Reads all runs of a share, which were all written. Returns the number of points in runs with a wrong
  /// check sum, or 0 if the share was searched before. Throws ShareError if a run cannot be read.
  std::uint64_t find(const std::vector<const ClusterShare*>& shares, std::size_t share,
                     const SpillFile& file);

  bool contains(std::size_t share, std::size_t run) const {
    return !lost_[share].empty() && lost_[share][run] != 0;
  }
  /// Returns whether a cell has lost points in it or around it.
  bool is_near(std::uint64_t cell) const { return !cells_.empty() && cells_.contains(cell); }

 private:
  std::vector<std::vector<std::uint8_t>> lost_;  // for each run of a share that was searched
  std::unordered_set<std::uint64_t> cells_;
};

}  // namespace pcl_bv::detail
