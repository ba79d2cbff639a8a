// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Parallelism as a value that the caller passes.
#pragma once

#include <variant>

namespace [[gnu::visibility("default")]] pcl_bv {

/// In the calling thread.
struct Serial {};

/// On OpenMP's pool, which the rest of the program may use, too. `threads` 0 means all processors that this
/// process may use. Ends when all threads have arrived: on a busy machine that is when the last one got a
/// core.
struct OpenMP {
  unsigned threads = 0;
};

/// On a pool of our own, whose threads sleep between calls and are not waited for unless they have begun: on
/// a busy machine never much slower than one thread. `threads` as above.
struct Threads {
  unsigned threads = 0;
};

using ParallelPolicy = std::variant<Serial, OpenMP, Threads>;

/// Threads that a policy would use, at least 1.
unsigned thread_count(const ParallelPolicy& policy);

/// The same policy with at most `threads` threads (at least 1).
ParallelPolicy limit_threads(const ParallelPolicy& policy, unsigned threads);

}  // namespace pcl_bv
