// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// One cloud in many inputs by shares, which become partial results, which become volumes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "pcl_bv/fitting/execution.h"
#include "pcl_bv/report/partial_file.h"
#include "pcl_bv/report/report.h"
#include "pipeline/filtered_view.h"
#include "status.h"
#include "tiles.h"

namespace pcl_bv {

Execution execution_of(const Options& options);

/// Points of tiles less an origin and filtered: a view, and what it stands on. Not to be moved.
class SharePoints {
 public:
  /// Of the points with these numbers. What the filter drops is counted in a pass of its own.
  SharePoints(const Tiles& tiles, const PointRange& range, const std::optional<Eigen::Vector3d>& origin,
              const Options& options);
  SharePoints(const SharePoints&) = delete;
  SharePoints& operator=(const SharePoints&) = delete;

  const PointView& view() const { return filtered_.points; }  ///< Numbered as the cloud is.
  const Counts& counts() const { return filtered_.counts; }

 private:
  std::unique_ptr<PointSource> shifted_;
  FilteredView filtered_;
};

/// What all shares of the cloud say of it: nothing of any share yet.
PartialFile describe_cloud(const Tiles& tiles, const std::optional<Eigen::Vector3d>& origin,
                           const Options& options);

/// Adds the points of a share, with these numbers.
void add_share(const SharePoints& points, const PointRange& range, const Execution& execution,
               PartialFile& file);

/// The files' results together. A file that cannot be read or does not belong to the others is complained of,
/// and then there is none.
std::optional<PartialFile> merge_files(const std::vector<std::string>& files);

/// A report on the whole cloud, with a place for the volume of each method.
Report report_of(const PartialFile& whole, const std::vector<const Method*>& methods);

/// What the fit of a method gave. Of results of the same points all are the same, but for the reason.
void set_volume(std::size_t place, const EstimationResult& result, AnyVolume volume, Report& report);

/// The job of --partial: to make that file, of inputs or of files that are merged.
Status make_partial_file(const Job& job, const Options& options);

/// Complains of every input that is left out: failed if there is one.
Status say_what_is_left_out(const Tiles& tiles);

/// Says what was noticed about the others.
void say_notes(const Tiles& tiles);

}  // namespace pcl_bv
