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
  /// load_cloud() throws. What `origin` asks for is subtracted from the points of xyz().
  LoadedCloud(const Job& job, bool hold, const ParallelPolicy& policy, const OriginOption& origin);

  /// Fields, size and viewpoint; the points only if it is held.
  const RawCloud& cloud() const { return file_ ? file_->header() : held_; }

  PointView xyz() const { return xyz_; }

  /// What was subtracted, if that was asked for.
  const std::optional<Eigen::Vector3d>& origin() const { return origin_; }

  /// Throws IoError if it was left in its file and that has been changed.
  void require_unchanged() const {
    if (file_) file_->require_unchanged();
  }

  /// To be changed by its last user.
  RawCloud take() { return std::move(held_); }

 private:
  std::unique_ptr<CloudFile> file_;
  RawCloud held_;
  PointView xyz_;  // of one of these, or of one of those below
  std::optional<Eigen::Vector3d> origin_;
  std::unique_ptr<PointSource> shifted_;
  std::vector<double> near_;  // the shifted points, if they have to be in memory
};

}  // namespace pcl_bv
