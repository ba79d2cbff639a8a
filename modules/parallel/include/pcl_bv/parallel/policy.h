// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parallelism as a value that the caller passes.
#pragma once

#include <variant>

namespace pcl_bv {

/// In the calling thread.
struct Serial {};

/// On OpenMP's pool. `threads` 0 means all processors that this process may use.
struct OpenMP {
  unsigned threads = 0;
};

/// On std::threads started for the call: for hosts without OpenMP, and for ThreadSanitizer, which does not
/// understand libgomp. `threads` 0 means all processors that this process may use.
struct Threads {
  unsigned threads = 0;
};

using ParallelPolicy = std::variant<Serial, OpenMP, Threads>;

/// Threads that a policy would use, at least 1.
unsigned thread_count(const ParallelPolicy& policy);

/// The same policy with at most `threads` threads (at least 1).
ParallelPolicy limit_threads(const ParallelPolicy& policy, unsigned threads);

}  // namespace pcl_bv
