// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The cloud of a job. It is in memory, or in its file if nothing needs all points at the same time.
#pragma once

#include <memory>

#include "inputs.h"
#include "pcl_bv/io/cloud_file.h"

namespace pcl_bv::detail {

class LoadedCloud {
 public:
  /// With `in_memory`, reads the cloud into memory. Generated and recorded clouds are always in memory. For a
  /// tiled cloud, `in_memory` has no effect: such a cloud is in memory if it has at most kChunkPoints points.
  /// The origin, if requested, is subtracted from the points of xyz(). `can_skip` is that of load_cloud().
  /// Throws as load_cloud(), and TileError for a tiled cloud.
  LoadedCloud(const Job& job, bool in_memory, const Execution& execution, const OriginOption& origin,
              const BoxPredicate& can_skip = {});

  /// Returns the cloud with fields, size and viewpoint. It has points only if the cloud is in memory.
  const RawCloud& cloud() const { return file_ ? file_->header() : cloud_; }

  PointView xyz() const { return xyz_; }

  /// Returns the origin that was subtracted; nullopt if no origin was requested.
  const std::optional<Eigen::Vector3d>& origin() const { return origin_; }

  /// Throws IoError if a file has been changed. For a tiled cloud, checks all files that have been opened.
  /// For any other cloud, checks the file only if the cloud is not in memory.
  void require_unchanged() const;

  /// Moves the cloud in memory to the caller. Must be the last access to the points.
  RawCloud take() { return std::move(cloud_); }

 private:
  void load_points();

  std::unique_ptr<CloudFile> file_;
  std::shared_ptr<const Tiles> tiles_;
  RawCloud cloud_;
  PointView xyz_;  // refers to the points in another member
  std::optional<Eigen::Vector3d> origin_;
  std::unique_ptr<PointSource> shifted_;
  // Copies of points, or empty. `points_` has the points of `xyz_`. `points_before_shift_` has the points of
  // a tiled cloud before the origin is subtracted.
  std::vector<std::byte> points_before_shift_, points_;
};

}  // namespace pcl_bv::detail
