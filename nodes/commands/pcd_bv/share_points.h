// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The points of one share of a cloud in several inputs.
#pragma once

#include <memory>
#include <optional>

#include "options.h"
#include "pcl_bv/parallel/execution.h"
#include "pcl_bv/report/partial_file.h"
#include "pipeline/filtered_view.h"
#include "tiles.h"

namespace pcl_bv::detail {

Execution execution_of(const Options& options);

/// The points of a share, relative to an origin and filtered, with the sources that load them. Cannot be
/// copied or moved.
class SharePoints {
 public:
  /// `range` holds the numbers of the points. The filter makes an additional pass over the points to count
  /// the dropped ones.
  SharePoints(const Tiles& tiles, const PointRange& range, const std::optional<Eigen::Vector3d>& origin,
              const Options& options);
  SharePoints(const SharePoints&) = delete;
  SharePoints& operator=(const SharePoints&) = delete;

  const PointView& view() const { return filtered_.points; }  ///< Points keep their numbers.
  const Counts& counts() const { return filtered_.counts; }

 private:
  std::unique_ptr<PointSource> shifted_;
  FilteredView filtered_;
};

/// Returns a partial file with the data that all shares of a cloud have in common. The file has no share yet.
PartialFile describe_cloud(const Tiles& tiles, const std::optional<Eigen::Vector3d>& origin,
                           const Options& options);

}  // namespace pcl_bv::detail
