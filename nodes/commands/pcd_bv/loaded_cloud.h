// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The cloud of a job: in memory, or in its file if nothing needs all points at once.
#pragma once

#include <memory>

#include "inputs.h"
#include "pcl_bv/io/cloud_file.h"

namespace pcl_bv {

class LoadedCloud {
 public:
  /// With `in_memory`, the cloud is read into memory by the threads of the policy. A tiled cloud is read into
  /// memory only if it has at most kChunkPoints points. The origin, if requested, is subtracted from the
  /// points of xyz(). Throws as load_cloud(), and TileError for a tiled cloud.
  LoadedCloud(const Job& job, bool in_memory, const ParallelPolicy& policy, const OriginOption& origin);

  /// Returns fields, size and viewpoint; the points only if the cloud is in memory.
  const RawCloud& cloud() const { return file_ ? file_->header() : cloud_; }

  PointView xyz() const { return xyz_; }

  /// Returns the origin that was subtracted, if one was requested.
  const std::optional<Eigen::Vector3d>& origin() const { return origin_; }

  /// Throws IoError if the cloud is not in memory and one of its files has been changed.
  void require_unchanged() const;

  /// Gives the cloud away to its last user.
  RawCloud take() { return std::move(cloud_); }

 private:
  void load_points();

  std::unique_ptr<CloudFile> file_;
  std::shared_ptr<const Tiles> tiles_;
  RawCloud cloud_;
  PointView xyz_;  // refers to one of the members around it
  std::optional<Eigen::Vector3d> origin_;
  std::unique_ptr<PointSource> shifted_;
  std::vector<std::byte> points_before_shift_, points_;  // tiles' points and shifted points, if in memory
};

}  // namespace pcl_bv
