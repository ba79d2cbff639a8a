// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <functional>
#include <variant>

namespace [[gnu::visibility("default")]] pcl_bv {

/// In the calling thread.
struct Serial {};

/// On OpenMP's pool, which the rest of the program may use, too. `threads` 0 means all processors that the
/// calling thread may use. Ends when all threads have arrived: on a busy machine that is when the last one
/// got a core. Not in a forked child whose parent used OpenMP: GNU's waits for ever there.
struct OpenMP {
  unsigned threads = 0;
};

/// On a pool of our own, whose threads sleep between calls and are not waited for unless they have begun: on
/// a busy machine never much slower than one thread. `threads` 0 means all processors that the process, which
/// is its main thread, may use.
///
/// A forked child has a pool of its own. The threads have the main thread's processors, policy and nice value
/// as they are when a thread starts, whoever calls first; they are never real-time, and signals are left to
/// the host's threads. Programs that want other threads hand over an Executor.
struct Threads {
  unsigned threads = 0;
};

/// On threads of the host's. `run(tasks, task)` calls task(0) ... task(tasks - 1), in any threads, side by
/// side or one after another, and returns when they have returned; `tasks` is at most `threads`, which is 0
/// for as many as for Threads. With TBB: `[](std::size_t tasks, const auto& task) {
/// tbb::parallel_for(std::size_t{0}, tasks, task); }`.
///
/// The calling thread does what tasks leave undone: `run` may also leave some out, or copy `task` and call it
/// later. What `run` throws is thrown on, when the tasks that have begun have ended; work may then be undone.
struct Executor {
  unsigned threads = 0;
  std::function<void(std::size_t tasks, const std::function<void(std::size_t)>& task)> run;
};

using ParallelPolicy = std::variant<Serial, OpenMP, Threads, Executor>;

/// Threads that a policy would use, at least 1. Throws std::invalid_argument for an Executor without `run`.
unsigned thread_count(const ParallelPolicy& policy);

/// The same policy with at most `threads` threads (at least 1). Throws as thread_count().
ParallelPolicy limit_threads(const ParallelPolicy& policy, std::size_t threads);

}  // namespace pcl_bv
