// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Labels of the points of shares.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "label_file.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/segmentation/cluster_share.h"
#include "spill_file.h"

namespace pcl_bv::detail {

/// A label and the check sum of the coordinates of each point of a cloud in shares.
struct ShareLabels {
  ShareLabels(const std::filesystem::path& folder, std::uint64_t count)
      : points(count), labels(folder, count), check_sums(folder, count) {}

  std::uint64_t points;  ///< All numbers of points are below it.
  LabelFile labels;
  LabelFile check_sums;  ///< Not 0 for points that a share has.
};

/// Tells the label of a run of a share: 0 if its points have labels already, nothing if it cannot be read.
using LabelOfRun = std::function<std::optional<std::uint32_t>(std::uint32_t share, std::uint32_t run)>;

/// How label_runs() works.
struct LabelExecution {
  ParallelPolicy policy;
  /// Of each thread. They are sorted by number before they are written, which takes 16 bytes for each.
  std::size_t points_at_a_time;
};

/// Reads all runs, and writes their labels and the check sums of their points. Throws ShareError.
void label_runs(const std::vector<const ClusterShare*>& shares, const LabelOfRun& label_of,
                const LabelExecution& execution, const SpillFile& file, ShareLabels& written);

}  // namespace pcl_bv::detail
