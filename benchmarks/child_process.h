// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Programs run to their end, with what the system says of them.
#pragma once

#include <string>
#include <vector>

namespace pcl_bv::bench {

struct ProcessCost {
  double seconds = 0;       ///< From its start to its end.
  double resident_mib = 0;  ///< Most memory that it ever had resident.
};

/// Runs a program without its output. Throws std::runtime_error if it does not end with status 0.
///
/// The system counts to a child what its parent had resident, so the parent has to stay small.
ProcessCost run_process(const std::vector<std::string>& command);

/// A program beside this one, found in PATH or given by its path; ended by SIGTERM with the object. Throws
/// std::runtime_error if it cannot be started.
class RunningProcess {
 public:
  explicit RunningProcess(const std::vector<std::string>& command);
  ~RunningProcess();
  RunningProcess(const RunningProcess&) = delete;
  RunningProcess& operator=(const RunningProcess&) = delete;

  double resident_mib() const;  ///< What it has resident now.

 private:
  int process_;
};

}  // namespace pcl_bv::bench
