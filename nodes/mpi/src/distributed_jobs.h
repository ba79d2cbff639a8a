// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Distributes independent inputs over the ranks.
#pragma once

#include <functional>
#include <mutex>
#include <vector>

#include "commands/pcd_bv/inputs.h"
#include "commands/pcd_bv/options.h"
#include "commands/pcd_bv/status.h"
#include "ranks.h"

namespace pcl_bv::detail {

/// The action that the first rank takes when a signal ends the run. Any thread may call both member
/// functions.
class InterruptAction {
 public:
  void set(std::function<void()> finish) {
    const std::lock_guard lock(mutex_);
    finish_ = std::move(finish);
  }
  void operator()() {
    const std::lock_guard lock(mutex_);
    if (finish_) finish_();
  }

 private:
  std::mutex mutex_;
  std::function<void()> finish_;
};

/// A collective call. Processes all jobs. The jobs are assigned to ranks in order of descending file size.
/// Each job goes to the rank to which the fewest bytes have been assigned so far. The first rank writes the
/// results in the order of the jobs and returns the status of the run. The other ranks return Status::done.
Status process_jobs(Ranks& ranks, const std::vector<Job>& jobs, const Options& options,
                    InterruptAction& interrupted);

}  // namespace pcl_bv::detail
