// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// The cloud of a job: in memory, or left in its file where nothing needs all points at a time.
#pragma once

#include <memory>

#include "inputs.h"
#include "pcl_bv/io/cloud_file.h"

namespace pcl_bv {

class LoadedCloud {
 public:
  /// `hold`: whether it has to be in memory; then the policy says on which threads it is read. Throws what
  /// load_cloud() throws, and TileError for a job of tiles, which are held only if they are few. What
  /// `origin` asks for is subtracted from the points of xyz().
  LoadedCloud(const Job& job, bool hold, const ParallelPolicy& policy, const OriginOption& origin);

  /// Fields, size and viewpoint; the points only if it is held.
  const RawCloud& cloud() const { return file_ ? file_->header() : held_; }

  PointView xyz() const { return xyz_; }

  /// What was subtracted, if that was asked for.
  const std::optional<Eigen::Vector3d>& origin() const { return origin_; }

  /// Throws IoError if it was left in files and one of those has been changed.
  void require_unchanged() const;

  /// To be changed by its last user.
  RawCloud take() { return std::move(held_); }

 private:
  void hold_points();

  std::unique_ptr<CloudFile> file_;
  std::shared_ptr<const Tiles> tiles_;
  RawCloud held_;
  PointView xyz_;  // of one of these, or of one of those below
  std::optional<Eigen::Vector3d> origin_;
  std::unique_ptr<PointSource> shifted_;
  std::vector<std::byte> unshifted_, near_;  // points of tiles and shifted ones, if they are in memory
};

}  // namespace pcl_bv
