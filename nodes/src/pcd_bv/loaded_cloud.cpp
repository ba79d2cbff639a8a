// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Generated clouds are always held.

#include "loaded_cloud.h"

namespace pcl_bv {

LoadedCloud::LoadedCloud(const Job& job, bool hold, const ParallelPolicy& policy,
                         const OriginOption& origin) {
  if (!hold && !job.error && !is_synth(job.input)) file_ = CloudFile::open(job.input, job.bin_fields);
  if (!file_) held_ = load_cloud(job, policy);
  if (!origin.asked) return;
  origin_ = origin.at ? *origin.at : whole_origin(stored(), policy);
  shifted_ = std::make_unique<ShiftedPoints>(stored(), *origin_);
  if (hold) near_ = load_all(shifted_->view());
}

PointView LoadedCloud::xyz() const {
  if (!shifted_) return stored();
  if (near_.empty()) return shifted_->view();
  return PointView::of(near_.data(), 3 * sizeof(double), near_.size() / 3);
}

}  // namespace pcl_bv
