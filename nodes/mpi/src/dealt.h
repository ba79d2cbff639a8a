// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Inputs that have nothing to do with one another, dealt out as work.
#pragma once

#include <functional>
#include <mutex>
#include <vector>

#include "commands/pcd_bv/inputs.h"
#include "commands/pcd_bv/options.h"
#include "commands/pcd_bv/status.h"
#include "ranks.h"

namespace pcl_bv {

/// What the first rank does when a signal ends the run.
class WhenInterrupted {
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

/// Processes all jobs, the largest files first to whoever has least; the first rank writes the results in the
/// order of the jobs. The status counts on the first rank only.
Status process_dealt(Ranks& ranks, const std::vector<Job>& jobs, const Options& options,
                     WhenInterrupted& interrupted);

}  // namespace pcl_bv
