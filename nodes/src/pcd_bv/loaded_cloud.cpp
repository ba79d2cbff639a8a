// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Generated clouds are always held.

#include "loaded_cloud.h"

namespace pcl_bv {

LoadedCloud::LoadedCloud(const Job& job, bool hold, const ParallelPolicy& policy) {
  if (!hold && !job.error && !is_synth(job.input)) file_ = CloudFile::open(job.input, job.bin_fields);
  if (!file_) held_ = load_cloud(job, policy);
}

}  // namespace pcl_bv
