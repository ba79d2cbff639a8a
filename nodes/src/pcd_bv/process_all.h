// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// All inputs over the cores.
#pragma once

#include <vector>

#include "inputs.h"
#include "options.h"
#include "status.h"

namespace pcl_bv {

/// Processes all jobs and writes their reports; what is written and said comes in the order of the jobs,
/// whatever the number of threads. At least as many jobs as threads are spread over the threads, each job
/// serial; fewer are done one after another, each with all threads. A job that fails stops no other; when
/// nobody reads the reports any more the work ends without complaint, unless it makes files or checks. With
/// several jobs a summary ends on standard error.
Status process_all(const std::vector<Job>& jobs, const Options& options);

}  // namespace pcl_bv
